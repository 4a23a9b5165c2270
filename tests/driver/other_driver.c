// Stands for a second OpenCL driver: any program that loads it ends at once.
#include <unistd.h>

__attribute__((constructor)) static void end_the_program(void)
{
    _exit(99);
}
