"""Prints the steps of a CI description that run something, "NAME<tab>COMMANDS", as its service would run them, after a
look at what must hold there.

ci_steps.py github|gitlab FILE
"""
import json
import pathlib
import sys

import jsonschema
import yaml

kind, file = sys.argv[1:]
description = yaml.safe_load(pathlib.Path(file).read_text())
schema = json.loads((pathlib.Path(__file__).parent / f"ci_{kind}.schema.json").read_text())
# YAML 1.1 reads the key `on` as a truth value.
description = {"on" if key is True else key: value for key, value in description.items()}
jsonschema.Draft202012Validator(schema).validate(description)
if kind == "github":
    for job in description["jobs"].values():
        for step in job["steps"]:
            if "run" in step:
                print(step["name"], step["run"], sep="\t")
else:
    for name, job in description.items():
        if "extends" not in job:
            continue
        if job["rules"] != [{"changes": [f"exercises/{name}/main.cpp"]}]:
            sys.exit(f"{file}: {name} runs when something else changes")
        script = description[job["extends"]]["script"]
        print(name, "; ".join([f"CI_JOB_NAME={name}", *script]), sep="\t")
