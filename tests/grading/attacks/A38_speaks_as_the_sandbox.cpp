// An error of the compiler that looks like a sandbox that fell.
#line 1 "bwrap: No permissions to create a new namespace"
#error of the sandbox
