constexpr Entry kTable[] = {
    {"show", "Show a frame", kRobot},
};
