"""Volumes of which only the cells that are asked for are read: Zarr, HDF5, Dask, TIFF, .npy, NIfTI and NRRD."""
