"""DICOM files by pydicom (extra `medical`): headers, places of frames, stacks, pixels and segments."""
