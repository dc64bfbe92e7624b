// Writes the document of the contact scenes to standard output.
#include <cstdio>

#include "contact/contact_table.h"

int main() { std::fputs(rex::contact::contactTable().c_str(), stdout); }
