"""Prints, of the JSON files that are named, those that fit a JSON Schema: check_schema.py SCHEMA FILE..."""
import json
import sys

import jsonschema


def read(name):
    with open(name, encoding="utf-8") as stream:
        return json.load(stream)


def main(schema_file, files):
    schema = read(schema_file)
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    for name in files:
        faults = [fault.message for fault in validator.iter_errors(read(name))]
        if faults:
            print(name, *faults, sep="\n", file=sys.stderr)
        else:
            print(name)


main(sys.argv[1], sys.argv[2:])
