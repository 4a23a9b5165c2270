// Does not compile: what a test of the error message needs.
kernel void render_packets(global float *pixels) { pixels[0] = undeclared_name; }
