// The stranger's program again, compiled for another instruction set than the library: it must not link.
#include "main.cpp"
