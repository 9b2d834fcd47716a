"""Holds files of results against their schemas: python3 -m tether.validate FOLDER [FOLDER...]

Every file below the folders whose name has a schema is read; what is not as the schema says is told by file and field.
Exit code 1 if there is anything. Needs jsonschema (Debian: python3-jsonschema).
"""

import json
import pathlib
import sys


def schema_folder():
    """docs/schema of the sources, or where it is installed."""
    here = pathlib.Path(__file__).resolve()
    candidates = [parent / part for parent in here.parents for part in ("docs/schema", "share/doc/tether/docs/schema")]
    for folder in candidates:
        if folder.is_dir():
            return folder
    raise FileNotFoundError("there are no schemas: neither docs/schema nor share/doc/tether/docs/schema above " + str(here))


def faults_of(file, schema):
    """One line for each thing that is not as the schema says."""
    import jsonschema

    validator = jsonschema.Draft202012Validator(schema)
    for error in validator.iter_errors(json.loads(file.read_text())):
        yield f"{file}: {'.'.join(str(part) for part in error.absolute_path) or 'the whole'}: {error.message[:200]}"


def validate(folders):
    """Returns the number of files that were held against a schema, and all faults."""
    schemas = {file.name: json.loads(file.read_text()) for file in schema_folder().glob("*.json")}
    files = [file for folder in folders for file in sorted(pathlib.Path(folder).rglob("*.json")) if file.name in schemas]
    return len(files), [fault for file in files for fault in faults_of(file, schemas[file.name])]


def main(folders):
    count, faults = validate(folders)
    print(*faults, f"{count} files held against their schemas, {len(faults)} faults", sep="\n")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
