#pragma once
/// Starts anew.
int anew = 0;
