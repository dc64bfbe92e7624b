// Includes a device.
#include "/dev/zero"
