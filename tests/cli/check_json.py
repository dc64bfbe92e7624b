"""Compares what a command printed with --json, on standard input, with its definition in commands.schema.json.

check_json.py SCHEMA DEFINITION
"""
import json
import sys

import jsonschema

file, definition = sys.argv[1:]
with open(file) as text:
    schema = json.load(text)
if definition not in schema["$defs"]:
    sys.exit(f"{file} has no definition '{definition}'")
schema["$ref"] = f"#/$defs/{definition}"
jsonschema.Draft202012Validator.check_schema(schema)
for error in jsonschema.Draft202012Validator(schema).iter_errors(json.load(sys.stdin)):
    print(f"{definition}{error.json_path[1:]}: {error.message}")
