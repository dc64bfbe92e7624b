const int kSecond = kFirst + 1;
