// Stands for a second OpenCL driver: it ends any program that loads it.
#include <unistd.h>

__attribute__((constructor)) static void end_the_program(void)
{
    _exit(99);
}
