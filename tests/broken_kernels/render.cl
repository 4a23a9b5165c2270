// Does not compile: what a test of the error message needs.
kernel void render_tiles(global float *pixels) { pixels[0] = undeclared_name; }
