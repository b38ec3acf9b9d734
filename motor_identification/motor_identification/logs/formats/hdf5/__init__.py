"""Arrays of an HDF5 file as MATLAB 7.3 writes it: groups of symbol tables, plain or chunked arrays, deflated."""
