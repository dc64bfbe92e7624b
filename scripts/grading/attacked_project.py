"""A project in a folder of its own: exercises of this one, and the one that the attacks of tests/grading are for."""

import pathlib
import shutil

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = ROOT / "build" / "release"
ATTACKED = "97-battery"
REX = BUILD / "tests" / "commands" / "rex_of_tree"  # REX FOLDER ARGUMENTS...: rex in that project


class AttackedProject:
    def __init__(self, folder, exercises):
        self.folder = folder
        build = folder / "build"
        for made in (build / "exercises", folder / "exercises" / ATTACKED):
            made.mkdir(parents=True)
        for name in ("rex-sandbox", "rex-sandbox-probe", "lib", "student"):
            (build / name).symlink_to(BUILD / name)
        for name in ("src", "share"):
            (folder / name).symlink_to(ROOT / name)
        for exercise in exercises:
            (folder / "exercises" / exercise).symlink_to(ROOT / "exercises" / exercise)
            (build / "exercises" / exercise).symlink_to(BUILD / "exercises" / exercise)
        (build / "exercises" / ATTACKED).symlink_to(BUILD / "tests" / "battery")
        for source in ("check.cpp", "exercise.h", "exercise.toml"):
            shutil.copy2(ROOT / "tests/grading/battery" / source, folder / "exercises" / ATTACKED / source)
