#!/usr/bin/env python3
"""Checks the house's rules: includes point downward only, the core is free of ROS, files and functions are short,
and ROS tests are run so that they can fail."""

import pathlib
import re
import sys

FLOORS = [
    ["geometry"],
    ["volume"],
    ["elasticity", "blade"],
    ["cutting", "contact", "surface"],
    ["simulation"],
    ["io"],
    ["ros"],
    ["nodes", "rviz"],
]
FLOOR_OF = {room: floor for floor, rooms in enumerate(FLOORS) for room in rooms}
ROOMS_WITH_ROS = {"ros", "nodes", "rviz", "rostest"}
MAX_FILE_LINES = 400
MAX_FUNCTION_LINES = 60

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')
ROS_HEADER = re.compile(
    r"^(ros|rosbag|rosgraph\w*|roslib|topic_tools|tf|tf2\w*|nodelet|pluginlib|class_loader|rviz|xmlrpcpp"
    r"|resource_retriever|diagnostic_updater|dynamic_reconfigure|message_filters|std_srvs|\w+_msgs)/"
    r"|^XmlRpc\w*\.h$"
    r"|^cfem_cutting/[A-Z]\w*\.h$"  # generated from msg/ and srv/
)
NOT_A_FUNCTION = re.compile(r"\b(namespace|class|struct|enum|union|extern)\b[^()]*\{$|=\s*\{$")


def source_files(package, tops):
    for top in tops:
        for path in sorted((package / top).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                yield path


def room_of(path):
    """The room of a file: src/<room>/…, include/cfem_cutting/<room>/…, test/<room>/…; None for other files."""
    parts = path.parts
    below = 2 if parts[0] == "include" else 1
    return parts[below] if len(parts) > below + 1 else None


def check_includes(path, lines):
    room = room_of(path)
    in_core = path.parts[0] in ("src", "include")
    if in_core and room is not None and room not in FLOOR_OF:
        yield f"{path}: unknown room '{room}', name it in {pathlib.Path(__file__).name}"
        return
    for number, line in enumerate(lines, 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        header = match.group(1)
        if ROS_HEADER.match(header) and room not in ROOMS_WITH_ROS:
            yield f"{path}:{number}: '{header}' belongs to ROS, and '{room}' is free of it"
        parts = header.split("/")
        if not in_core or len(parts) < 3 or parts[0] != "cfem_cutting" or parts[1] == room:
            continue
        included = parts[1]
        if FLOOR_OF.get(included, len(FLOORS)) >= FLOOR_OF.get(room, len(FLOORS)):
            yield f"{path}:{number}: '{room}' may not include '{header}', which is not on a lower floor"


def check_lengths(path, lines):
    if len(lines) > MAX_FILE_LINES:
        yield f"{path}: {len(lines)} lines, more than {MAX_FILE_LINES}"
    opened = {}  # indentation → line number of the block that is open there; relies on clang-format's layout
    for number, line in enumerate(lines, 1):
        text = line.split("//")[0].rstrip()
        indentation = len(text) - len(text.lstrip())
        if text.lstrip().startswith("}") and indentation in opened:
            length = number - opened.pop(indentation) - 1
            if length > MAX_FUNCTION_LINES:
                yield f"{path}:{number - length - 1}: a function of {length} lines, more than {MAX_FUNCTION_LINES}"
        if text.endswith("{") and indentation <= 2 and not NOT_A_FUNCTION.search(text):
            opened[indentation] = number
        elif text.endswith("{"):
            opened.pop(indentation, None)


def check_rostests(path, lines):
    """`rostest --text` exits with 0 whatever happens, so that a test run with it cannot fail."""
    for number, line in enumerate(lines, 1):
        if re.search(r"\brostest\b.*\s(--text|-t)\b", line.split("#")[0]):
            yield f"{path}:{number}: 'rostest --text' never reports a failure; leave --text out"


def main():
    package = pathlib.Path(__file__).resolve().parent.parent
    complaints = []
    for path in source_files(package, ["include", "src", "test", "benchmark"]):
        lines = path.read_text(encoding="utf-8").splitlines()
        relative = path.relative_to(package)
        complaints += check_includes(relative, lines)
        complaints += check_lengths(relative, lines)
    for path in sorted((package / "cmake").glob("*.cmake")):
        complaints += check_rostests(path.relative_to(package), path.read_text(encoding="utf-8").splitlines())
    print("\n".join(complaints), end="\n" if complaints else "")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
