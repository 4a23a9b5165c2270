// A kernel that does not compile, to test the error message.
kernel void render_tiles(global float *pixels) { pixels[0] = undeclared_name; }
