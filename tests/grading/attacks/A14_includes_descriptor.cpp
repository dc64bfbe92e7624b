// Includes a device.
#include "/proc/self/fd/0"
