void addShow(App& program) { add(program, "show", "Show a frame"); }
