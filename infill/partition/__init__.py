"""A whole segmentation smoothed together: one complex of surfaces, with walls that neighbours share."""
