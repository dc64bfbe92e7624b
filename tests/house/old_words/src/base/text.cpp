// Starts anew.
const char* text() { return "x"; }
