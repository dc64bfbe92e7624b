// Includes a device.
#include "/dev/tty"
