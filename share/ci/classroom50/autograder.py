#!/usr/bin/env python3
"""The autograder of an assignment of Classroom 50 that is called like its exercise: share/doc/platforms.md.

Runs in a student's course folder, and writes result.json in the format classroom50/result/v1. Ends with an exit code
other than 0, which Classroom 50 shows as an error of the grader, only if there is no result.
"""
import datetime
import json
import os
import pathlib
import subprocess

folder = pathlib.Path("out/classroom50")
subprocess.run(["rex", "test", os.environ["ASSIGNMENT"].split("-")[0], "-o", folder], check=False)
graded = json.loads((folder / "results.json").read_text())
assert graded["outcome"] != "grader_error", graded["message"]
tests = [
    {"test-name": check["title"], "passed": check["status"] == "pass", "score": check["points"],
     "max-score": check["max_points"]} for check in graded["checks"] if check["group"] == "visible"
]
pathlib.Path("result.json").write_text(json.dumps({
    "schema": "classroom50/result/v1",
    "classroom": os.environ["CLASSROOM"],
    "assignment": os.environ["ASSIGNMENT"],
    "submission": os.environ["SUBMISSION_TAG"],
    "commit": os.environ["COMMIT_URL"],
    "release": os.environ["RELEASE_URL"],
    "review": os.environ.get("REVIEW_URL") or os.environ["COMMIT_URL"],
    "datetime": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
    "score": sum(test["score"] for test in tests),
    "max-score": sum(test["max-score"] for test in tests),
    "tests": tests}, indent=2))
