// Includes a device.
#include "/dev/stdin"
