"""A class that does not exist, and what platforms let a lecturer download of it.

Of twenty in a row seven are honest, two wrong, two lucky, two attack, two are late, one is missing, two are a pair, one
hands in an archive that nobody should unpack, and one a file that does not compile. Every file holds a mark of its own.
"""

import csv
import dataclasses
import datetime
import io
import json
import os
import random
import re
import subprocess
import unicodedata
import zipfile
import zoneinfo

import submissions
from attacked_project import ATTACKED, ROOT

BASICS = "00-basics"
KINDS = (["honest"] * 7 + ["wrong"] * 2 + ["lucky"] * 2 + ["attack"] * 2 +
         ["late", "late wrong", "missing", "pair", "pair", "hostile", "broken"])
DEADLINE = 1_795_215_540  # 2026-11-20T22:59:00Z
# The second and the third are one name, composed and decomposed. Commas, quotes and blanks are those of real lists.
NAMES = ["Zoe Miller", "Jürgen Groß", unicodedata.normalize("NFD", "Jürgen Groß"), "José Peña", "Nguyễn Thị Hoa",
         "Łukasz Żak", "Adam O'Hara", "Änne Müller-Weiß", "Li Wei", "Bo", "Çağla Öztürk", "Max, jun.", "Ada",
         "Ïa \"Io\" Q", "Eva", "Tim", "Uwe", "Ana", "Kim", "Jo"]
# They keep the compiler or the machine busy until a limit.
SLOW = re.compile(r"A0[569]|A1[04-6]|A34")
MARK = re.compile(r"MARK-\d{4}-[0-9a-f]{8}")


@dataclasses.dataclass
class Student:
    k: int
    kind: str
    name: str
    mark: str
    time: int
    texts: dict = dataclasses.field(default_factory=dict)  # by exercise; of a pair the first one's
    bound: int = 10  # the most points an attack may get
    group: str = ""
    partner: object = None
    is_second: bool = False

    id = property(lambda self: f"s{self.k:04}")
    email = property(lambda self: f"student{self.k}@uni.example")
    number = property(lambda self: f"31{self.k:05}")
    user = property(lambda self: f"octo-{self.k}")
    attempts = property(lambda self: 1 + self.k % 3)


def made_up_class(count, seed):
    rng = random.Random(seed)
    honest = (ROOT / "tests/grading/battery/honest.cpp").read_text()
    lines = [line.split("\t") for line in (ROOT / "tests/grading/attacks.tsv").read_text().splitlines()[1:]]
    attacks = [(line[0], int(line[4])) for line in lines if not SLOW.match(line[0])]
    basics = ROOT / "exercises" / BASICS
    solution, wrong = submissions.reference(basics), submissions.wrong_variants(basics)
    students = []
    for k in range(count):
        place = k % 20
        kind = KINDS[place]
        mark = f"MARK-{k:04}-{rng.getrandbits(32):08x}"
        late = 3600 * (2 + 30 * (k // 20 % 3)) if kind.startswith("late") else -60 * (1 + 37 * k)
        name = NAMES[place] if place in (1, 2) else f"{NAMES[place]} {k // 20 + 1}" if k >= 20 else NAMES[place]
        one = Student(k, kind, name, mark, DEADLINE + late)
        text = honest
        if kind.endswith("wrong"):
            text = honest.replace("2 * x", "2 * x + 1")
        elif kind == "lucky":  # passes or fails the hidden check, as the seed will have it
            text = honest.replace("2 * x", f"(x > {10 + 7 * k % 80} && x < {15 + 7 * k % 80}) ? 0 : 2 * x")
        elif kind == "attack":
            attack, one.bound = rng.choice(attacks)
            text = (ROOT / f"tests/grading/attacks/{attack}.cpp").read_text()
        elif kind == "broken":
            text = honest + "int broken(\n"
        if kind != "missing":
            one.texts[ATTACKED] = text + f"\n// {mark}\n"
        if kind == "pair" and students and students[-1].kind == "pair" and not students[-1].is_second:
            one.partner, one.is_second, one.group = students[-1], True, f"pair-{k // 20}"
            one.texts, one.time = students[-1].texts, students[-1].time
            students[-1].partner, students[-1].group = one, one.group
        elif place in (0, 7):
            one.texts[BASICS] = (solution if place == 0 else wrong[rng.choice(sorted(wrong))]) + f"\n// {mark}\n"
        students.append(one)
    return students


def in_zip(members):
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    return packed.getvalue()


def upload(student, exercise):
    """What a student uploads: name to content."""
    text = student.texts[exercise]
    if student.kind == "hostile":
        return {"work.zip": in_zip({"../../../tmp/main.cpp": text})}
    return [{"main.cpp": text}, {"work.zip": in_zip({f"{exercise}/main.cpp": text})}, {"main (1).cpp": text},
            {"course.zip": in_zip({f"course/exercises/{exercise}/main.cpp": text})}][student.k % 4]


def those_of(students, exercise):
    return [student for student in students if exercise in student.texts]


def instant(time, zone="UTC", form="%Y-%m-%dT%H:%M:%SZ"):
    return datetime.datetime.fromtimestamp(time, zoneinfo.ZoneInfo(zone)).strftime(form)


def write_csv(file, rows):
    with open(file, "w", newline="", encoding="utf-8") as lines:
        csv.writer(lines).writerows(rows)


def moodle(folder, students, exercise, points):
    """The zip and the worksheet of an assignment."""
    first = 500 if exercise == ATTACKED else 2500
    members, rows = {}, [["Identifier", "Full name", "Email address", "Status", "Grade", "Maximum Grade",
                          "Last modified (submission)", "Last modified (grade)", "Feedback comments"]]
    for student in students:
        has = exercise in student.texts
        if has:
            group = student.group + "-" if student.group else ""
            where = f"{group}{student.name}_{first + student.k}_assignsubmission_file_"
            for name, content in upload(student.partner if student.is_second else student, exercise).items():
                members[f"{where}/{name}"] = content
        time = instant(student.time, "Europe/Berlin", "%A, %d %B %Y, %I:%M %p") if has else "-"
        rows.append([f"Participant {first + student.k}", student.name, student.email,
                     "Submitted for grading" if has else "No submission", "", f"{points}.00", time, "-", ""])
    (folder / f"{exercise}.zip").write_bytes(in_zip(members))
    write_csv(folder / f"{exercise}.csv", rows)


def gradescope(folder, students, exercise):
    quoted, members, text = json.dumps, {}, "---\n"
    for student in those_of(students, exercise):
        if student.is_second:
            continue
        name = f"submission_{500 + student.k}"
        text += f"{name}:\n  :submitters:\n"
        for one in [student] + ([student.partner] if student.partner else []):
            text += f"  - :name: {quoted(one.name, ensure_ascii=False)}\n    :sid: '{one.number}'\n"
            text += f"    :email: {one.email}\n"
        text += f"  :created_at: {instant(student.time, form='%Y-%m-%d %H:%M:%S')}.250000000 Z\n  :history:\n"
        text += "".join(f"  - :id: {k}\n    :score: 0.0\n" for k in range(student.attempts - 1)) or "  []\n"
        for file, content in upload(student, exercise).items():
            members[f"export/{name}/{file}"] = content
    members["export/submission_metadata.yml"] = text
    (folder / f"{exercise}.zip").write_bytes(in_zip(members))


def folders(folder, students, exercise):
    for student in those_of(students, exercise):
        if student.is_second:
            continue
        for name, content in upload(student, exercise).items():
            file = folder / exercise / student.id / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(content if isinstance(content, bytes) else content.encode())
            os.utime(file, (student.time, student.time))


def git_clones(folder, students):
    """Clones with a whole course inside, roster and record."""
    handed_out = (ROOT / "exercises" / BASICS / "main.cpp").read_text()
    record = [["assignment_name", "github_username", "roster_identifier", "student_repository_name",
               "submission_timestamp", "points_awarded", "points_available", "group_name", "commit"]]
    write_csv(folder / "roster.csv", [["identifier", "github_username", "github_id", "name"]] +
              [[student.id, student.user, student.k, student.name] for student in students])

    def git(*words, time=DEADLINE):
        return subprocess.run(["git", "-c", "user.name=x", "-c", "user.email=x@x", "-c", "commit.gpgsign=false", *words],
                              cwd=clone, check=True, capture_output=True, text=True,
                              env=os.environ | {"GIT_COMMITTER_DATE": f"{time} +0000"}).stdout.strip()

    for student in students:
        if not student.texts:
            continue
        owner = student.partner if student.is_second else student
        name = f"course-{owner.user}"
        clone = folder / "clones" / name
        if not student.is_second:
            for exercise, text in {BASICS: handed_out, **student.texts}.items():
                file = clone / "exercises" / exercise / "main.cpp"
                file.parent.mkdir(parents=True)
                if student.kind == "hostile" and exercise == ATTACKED:
                    file.symlink_to("/etc/passwd")
                else:
                    file.write_text(text)
            git("init", "-q")
            git("add", "-A")
            git("commit", "-qm", "work", time=student.time)
            commit = git("rev-parse", "HEAD")
            (clone / "later").write_text("too late")
            git("add", "-A")
            git("commit", "-qm", "dated back", time=student.time - 100)
        record.append(["Course", student.user, student.id, name, instant(student.time), "", 10, student.group, commit])
    write_csv(folder / "record.csv", record)


def course(file, students, adjustments):
    quoted = lambda text: json.dumps(text, ensure_ascii=False)
    late = [student.id for student in students if student.kind == "late"][:1]
    text = f"""title = "Robotics, a class that does not exist"
[all]
deadline = {instant(DEADLINE)}
grace_minutes = 15
percent_per_day = 10
[exercise.{ATTACKED}]
opening = {instant(DEADLINE - 14 * 86400)}
weight = 2
[exercise.{BASICS}]
"""
    if late:
        text += f"[exercise.{ATTACKED}.extensions]\n{late[0]} = {instant(DEADLINE + 86400)}\n"
    for student in students:
        text += f"[[student]]\nid = {quoted(student.id)}\nname = {quoted(student.name)}\n"
        text += f"email = {quoted(student.email)}\nnumber = {quoted(student.number)}\n"
        text += f"group = {quoted(student.group)}\n" if student.group else ""
    file.write_text(text, encoding="utf-8")
    wrong, group = students[7].id, next((student.group for student in students if student.group), "")
    by = f'exercise = "{ATTACKED}"\nauthor = "A. Tutor"\n'
    said = f'[[adjustment]]\nstudent = "s0000"\n{by}add = 0.5\nreason = "a good question"\ndate = 2026-12-01\n'
    said += f'[[adjustment]]\nstudent = "{wrong}"\n{by}check = "examples"\npoints = 3\n'
    said += 'reason = "our sign"\ndate = 2026-12-01\n'
    said += f'[[comment]]\nstudent = "{wrong}"\n{by}line = 3\ntext = "One too many & <b>."\n'
    if group:
        said += f'[[comment]]\ngroup = "{group}"\n{by}text = "Well done, both."\n'
    adjustments.write_text(said, encoding="utf-8")
