"""A second opinion on reports, by readers that share no code with their writers.

check_reports.py valid FORMAT FILE...   a line "FILE: why" for each file that breaks the schema in share/grading
check_reports.py equal FOLDER           the same for all CASE.FORMAT of a folder, and what differs from CASE.results
Exit code 1 if there is any such line.
"""
import html
import json
import pathlib
import re
import subprocess
import sys
import unicodedata
import urllib.parse
import xml.etree.ElementTree as ElementTree

import jsonschema
import markdown_it

SCHEMAS = pathlib.Path(__file__).resolve().parents[2] / "share" / "grading"
FAULT = "The grader itself failed"


def json_faults(name, files):
    schema = json.loads((SCHEMAS / f"{name}.schema.json").read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    for file in files:
        try:
            error = next(validator.iter_errors(json.loads(file.read_bytes())), None)
            if error:
                yield file, f"{error.json_path}: {error.message[:200]}"
        except ValueError as error:
            yield file, f"not JSON: {error}"


def xml_faults(files):
    for start in range(0, len(files), 200):
        command = ["xmllint", "--noout", "--schema", SCHEMAS / "junit.xsd", *files[start:start + 200]]
        said = subprocess.run(command, capture_output=True, text=True, errors="replace").stderr.splitlines()
        for file in files[start:start + 200]:
            if f"{file} validates" not in said:
                yield file, next((line for line in said if str(file) in line), "xmllint says nothing")[:400]


def text_faults(name, files):
    grammar = re.compile((SCHEMAS / f"{name}.regex").read_text(), re.VERBOSE)
    for file in files:
        try:
            text = file.read_bytes().decode("utf-8")
        except UnicodeDecodeError as error:
            yield file, f"not UTF-8: {error}"
            continue
        if not grammar.fullmatch(text):
            yield file, "does not match the grammar"


def faults(name, files):
    if name == "junit":
        return xml_faults(files)
    return json_faults(name, files) if (SCHEMAS / f"{name}.schema.json").exists() else text_faults(name, files)


def is_invisible(character):
    code = ord(character)
    never = code & 0xFFFE == 0xFFFE or 0xFDD0 <= code <= 0xFDEF
    name = unicodedata.name(character, "")
    ignored = "VARIATION SELECTOR" in name or ("HANGUL" in name and name.endswith("FILLER"))
    kept = character in "\n\t"
    return not kept and (never or ignored or unicodedata.category(character) in ("Cc", "Cf", "Zl", "Zp", "Cs"))


def shown(text, limit=4000):
    """What a report shows of a text: nothing without a look of its own, and a mark where it was cut."""
    text = "".join("\ufffd" if is_invisible(character) else character for character in text)
    whole = text.encode("utf-8")
    return text if len(whole) <= limit else whole[:limit - 4].decode("utf-8", "ignore") + " ..."


def message_of(check, result):
    text = shown(check["message"] or check["status"].replace("_", " "))
    files = result["submission"]["files"]
    name = shown(files[0]["name"]) if files else "main.cpp"
    place = f"\n{name}:{check['line']}" if check["line"] > 0 else ""
    return text + place + (f"\ninput: {shown(check['input'])}" if check["input"] else "")


class Comparison:
    def __init__(self, result):
        self.result = result
        self.checks = result["checks"]
        self.visible = [check for check in self.checks if check["group"] == "visible"]
        self.hidden = [check for check in self.checks if check["group"] == "hidden"]
        self.is_fault = result["outcome"] == "grader_error"
        self.is_broken = result["outcome"] == "compile_error"
        self.points = f"{result['score']} of {result['max_score']} points"
        self.differences = []

    def expect(self, what, found, wanted):
        if found != wanted:
            self.differences.append(f"{what}: {str(found)[:200]!r} instead of {str(wanted)[:200]!r}")

    def gradescope(self, text):
        report = json.loads(text)
        if self.is_fault:
            self.expect("fault", ("score" in report, report["output"].startswith(FAULT)), (False, True))
            return
        tests = report["tests"]
        self.expect("score", report["score"], self.result["score"])
        self.expect("sum", sum(test["score"] for test in tests), self.result["score"])
        self.expect("maximum", sum(test["max_score"] for test in tests), self.result["max_score"])
        self.expect("names", [test["name"] for test in tests], [shown(check["title"]) for check in self.checks])
        for test, check in zip(tests, self.checks):
            self.expect("status", test["status"] == "passed", check["status"] == "pass")
            self.expect("visibility", test["visibility"] == "visible", check["group"] == "visible")
            if check["group"] == "visible":
                wanted = "" if check["status"] == "pass" else message_of(check, self.result)
                self.expect("output", test["output"], wanted)

    def junit(self, text):
        def allowed(value):
            return re.sub("[\ufffe\uffff]", "\ufffd", value)

        root = ElementTree.fromstring(text)
        suite = root.find("testsuite")
        cases = suite.findall("testcase")
        for element in (root, suite):
            self.expect("tests", int(element.get("tests")), len(cases))
            for count, child in (("failures", "failure"), ("errors", "error"), ("skipped", "skipped")):
                self.expect(count, int(element.get(count)), len(suite.findall(f"testcase/{child}")))
        properties = {p.get("name"): p.get("value") for p in suite.findall("properties/property")}
        self.expect("score", int(properties["score"]), self.result["score"])
        self.expect("maximum", int(properties["max_score"]), self.result["max_score"])
        self.expect("stdout", suite.findtext("system-out"), allowed(shown(self.result["stdout"], 50000)))
        self.expect("stderr", suite.findtext("system-err"), allowed(shown(self.result["stderr"], 50000)))
        self.expect("unique names", len({case.get("name") for case in cases}), len(cases))
        if self.is_fault or self.is_broken:
            self.expect("error", cases.pop(0).find("error").get("type"), self.result["outcome"])
        self.expect("cases", len(cases), len(self.checks))
        hidden = 0
        for case, check in zip(cases, self.checks):
            hidden += check["group"] == "hidden"
            name = f"Hidden check {hidden}" if check["group"] == "hidden" else (
                f"{shown(check['title'])} [{shown(check['id'])}]")
            self.expect("name", case.get("name"), allowed(name))
            self.expect("pass", len(case) == 0, check["status"] == "pass")
            told = next(iter(case), None)
            if told is None or told.tag == "skipped":
                continue
            self.expect("type", told.get("type"), check["status"])
            text = check["status"].replace("_", " ") if check["group"] == "hidden" else message_of(check, self.result)
            self.expect("text", told.text, allowed(f"{check['points']} of {check['max_points']} points: {text}"))

    def github(self, text):
        found = {"error": [], "warning": [], "notice": []}
        for line in text.split("\n")[:-1]:
            kind, properties, message = re.fullmatch("::(error|warning|notice) (.*?)::(.*)", line).groups()
            title = properties.split(",")[0].removeprefix("title=")
            found[kind].append((urllib.parse.unquote(title), urllib.parse.unquote(message)))
        title = shown(self.result["exercise"]["id"])
        if self.is_fault:
            self.expect("fault", (len(found["error"]), found["notice"]), (1, []))
            return
        wanted = {"error": [], "warning": []}
        for said in self.result["compile"]["diagnostics"]:
            rule = f" [{said['rule']}]" if said["rule"] else ""
            kind = "error" if said["severity"] == "error" else "warning"
            wanted[kind].append((title, shown(said["message"] + rule, 1000)))
        for check in self.visible:
            if check["status"] not in ("pass", "not_run"):
                wanted["error"].append((f"{shown(check['title'])} ({check['points']}/{check['max_points']})",
                                        shown(check["message"] or check["status"].replace("_", " "), 1000)))
        if self.is_broken and not wanted["error"]:
            self.expect("reason", [told for told, message in found["error"] if message], [title])
            wanted["error"] = found["error"]
        # Ten at most, of which the last is the notice.
        left = 9
        for kind in wanted:
            self.expect(kind, found[kind], wanted[kind][:left])
            left -= len(wanted[kind][:left])
        more = sum(map(len, wanted.values())) - sum(len(found[kind]) for kind in wanted)
        self.expect("notice", found["notice"], [(title, self.points + (f"; {more} more in the summary" if more else ""))])

    def markdown(self, text):
        def squeezed(value):
            return " ".join(value.split())

        def line(value):
            return shown(value, 600).replace("\n", " ").replace("\t", " ")

        tokens = markdown_it.MarkdownIt("commonmark").enable("table").parse(text)
        kinds = {token.type.removesuffix("_open") for token in tokens if not token.type.endswith("_close")}
        self.expect("elements", kinds - {"heading", "inline", "paragraph", "html_block", "table", "thead", "tbody",
                                         "tr", "th", "td"}, set())
        texts = [token for token in tokens if token.type == "inline"]
        self.expect("markup in texts", {part.type for token in texts for part in token.children} - {"text"}, set())
        texts = [squeezed("".join(part.content for part in token.children)) for token in texts]
        total = ": not graded" if self.is_fault else f": {self.points}"
        self.expect("title", texts[0], squeezed(f"## {line(self.result['exercise']['id'])}{total}")[3:])
        if self.is_fault:
            return
        wanted, hidden = [], 0
        for check in [] if self.is_broken else self.checks:
            is_hidden = check["group"] == "hidden"
            hidden += is_hidden
            name = f"Hidden check {hidden}" if is_hidden else f"{line(check['title'])} ({line(check['id'])})"
            silent = is_hidden or check["status"] in ("pass", "not_run")
            wanted += [squeezed(cell) for cell in (
                check["status"].replace("_", " "), name, f"{check['points']}/{check['max_points']}",
                "" if silent else line(message_of(check, self.result)))]
        rows = [token.type for token in tokens].count("tr_open")
        self.expect("number of rows", rows, 0 if self.is_broken else 1 + len(self.checks))
        self.expect("rows", texts[5:5 + len(wanted)], wanted)
        self.expect("blocks", text.count("<pre>"), text.count("</pre>"))
        printed = self.result["stdout"]
        printed += "\n" * bool(printed and self.result["stderr"] and printed[-1] != "\n") + self.result["stderr"]
        if printed:
            block = [token.content for token in tokens if token.type == "html_block"][-1]
            printed = shown(shown(printed, 50000).rstrip("\n"), 16000)
            self.expect("printed", html.unescape(block), f"<pre>\n{printed}\n</pre>\n")


FORMATS = ("github", "gradescope", "junit", "markdown")


def differences(folder):
    for file in sorted(folder.glob("*.results")):
        result = json.loads(file.read_bytes())
        for name in FORMATS:
            report = file.with_suffix(f".{name}")
            comparison = Comparison(result)
            getattr(comparison, name)(report.read_bytes().decode("utf-8"))
            for difference in comparison.differences:
                yield report, difference


def main():
    if sys.argv[1] == "valid":
        found = list(faults(sys.argv[2], [pathlib.Path(name) for name in sys.argv[3:]]))
    else:
        folder = pathlib.Path(sys.argv[2])
        found = list(json_faults("result", sorted(folder.glob("*.results"))))
        found += [fault for name in FORMATS for fault in faults(name, sorted(folder.glob(f"*.{name}")))]
        found = found or list(differences(folder))
    for file, why in found:
        print(f"{file}: {why}")
    sys.exit(bool(found))


main()
