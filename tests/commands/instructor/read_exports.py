"""Reads back what `rex export` wrote, by readers that share no code with it; prints what they found as JSON.

read_exports.py moodle FOLDER | html FOLDER | csv FILE | json FILE SCHEMA
"""
import csv
import html.parser
import json
import pathlib
import sys
import zipfile


def moodle_file(name):
    """As Moodle takes the path of a feedback file apart: number, plugin and the file for the student."""
    parts = name.split("/")
    while parts:
        info = parts.pop(0).split("_", 4)
        if len(info) >= 4 and info[1].isdigit():
            rest = info[4:] + parts if len(info) == 5 else parts
            return [info[1], info[2] + "_" + info[3], "/".join(part for part in rest if part)]
    return None


class Page(html.parser.HTMLParser):
    VOID = {"meta", "img", "br", "link"}

    def __init__(self, text):
        super().__init__()
        self.open, self.faults, self.tags, self.links, self.text = [], [], set(), [], ""
        self.feed(text)
        self.close()
        self.faults += [f"{tag} stays open" for tag in self.open]

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        self.links += [value for key, value in attributes if key in ("href", "src")]
        self.faults += [key for key, value in attributes if key.startswith("on")]
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"{tag} ends")

    def handle_data(self, data):
        self.text += data


def read_moodle(folder):
    with zipfile.ZipFile(folder / "feedback.zip") as packed:
        assert packed.testzip() is None
        return sorted(moodle_file(name) for name in packed.namelist())


def read_html(folder):
    pages = {}
    for file in sorted(folder.rglob("feedback.html")):
        page = Page(file.read_text(encoding="utf-8"))
        for link in page.links:
            if not link.startswith("data:image/png;base64,") and not (file.parent / link).is_file():
                page.faults.append(f"no {link}")
        pages[str(file.parent.relative_to(folder))] = {"faults": page.faults, "tags": sorted(page.tags),
                                                      "links": len(page.links), "text": page.text}
    return pages


def read_json(file, schema):
    import jsonschema
    jsonschema.Draft202012Validator.check_schema(json.loads(schema.read_text()))
    jsonschema.validate(json.loads(file.read_text()), json.loads(schema.read_text()))
    return "valid"


kind, *paths = sys.argv[1:]
paths = [pathlib.Path(path) for path in paths]
if kind == "csv":
    with open(paths[0], newline="", encoding="utf-8-sig") as lines:
        found = list(csv.reader(lines, strict=True))
else:
    found = {"moodle": read_moodle, "html": read_html, "json": read_json}[kind](*paths)
print(json.dumps(found))
