"""Make an outcome map: a grid over two fields of a scenario, tossed tile by tile into a Zarr store."""
