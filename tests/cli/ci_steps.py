"""Prints the shell commands of a CI description as its service would run them, after a look at what must hold there.

ci_steps.py github|gitlab FILE
"""
import json
import pathlib
import sys

import jsonschema
import yaml

kind, file = sys.argv[1:]
text = pathlib.Path(file).read_text()
description = yaml.safe_load(text)
schema = json.loads((pathlib.Path(__file__).parent / f"ci_{kind}.schema.json").read_text())
# YAML 1.1 reads the key `on` as a truth value.
description = {"on" if key is True else key: value for key, value in description.items()}
jsonschema.Draft202012Validator(schema).validate(description)
for job in description["jobs"].values() if kind == "github" else [description["grade"]]:
    for step in job["steps"] if kind == "github" else job["script"]:
        command = step.get("run") if kind == "github" else step
        if command:
            print(command)
