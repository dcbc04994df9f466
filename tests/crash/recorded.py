# SPDX-License-Identifier: Apache-2.0
"""The system calls of a run, and the states of its folder that a loss of power may leave at any of them."""
import os
import re
import subprocess

CALLS = "openat,open,creat,write,writev,pwrite64,fsync,fdatasync,rename,renameat,renameat2,unlink,unlinkat,rmdir,mkdir,mkdirat," \
        "ftruncate,truncate,close,dup,dup2,dup3"
LINE = re.compile(r"^(\d+) +(\w+)\((.*)\) += (-?\d+|\?)")
BLOCK = 512  # what a disk writes whole


def strace_works():
    try:
        return subprocess.run(["strace", "-o", os.devnull, "true"], check=False, stderr=subprocess.DEVNULL).returncode == 0
    except FileNotFoundError:
        return False


def record(command, folder, trace):
    """Runs a command under strace; the completed calls in their order, as (name, arguments, result)."""
    ended = subprocess.run(["strace", "-f", "-qq", "-xx", "-s", "100000000", "-e", "signal=none", "-e", f"trace={CALLS}",
                            "-o", trace, *command], cwd=folder, check=False, stdout=subprocess.DEVNULL,
                           stderr=subprocess.PIPE, text=True)
    begun, calls = {}, []
    with open(trace, encoding="ascii") as stream:
        for line in stream:
            process = line.split(" ", 1)[0]
            if line.endswith("<unfinished ...>\n"):
                begun[process] = line[:-len("<unfinished ...>\n")].rstrip()
                # Another thread may be given the descriptor before close() comes back.
                if closed := re.match(r"^\d+ +close\((\d+)", line):
                    calls.append(("close", [closed[1]], 0))
                continue
            resumed = re.match(r"^\d+ +<\.\.\. \w+ resumed>(.*)$", line, re.S)
            if resumed:
                line = begun.pop(process) + resumed[1]
                if " close(" in line:
                    continue
            found = LINE.match(line)
            if found and found[4] != "?":
                calls.append((found[2], split(found[3]), int(found[4])))
    return ended.returncode, calls


def split(arguments):
    """Arguments of a call; strings in hexadecimal become bytes."""
    parts = re.findall(r'"((?:\\x[0-9a-f]{2})*)"|([^,"\s][^,"]*)', arguments)
    return [bytes.fromhex(text.replace("\\x", "")) if not other else other.strip() for text, other in parts]


class Disk:
    """What stands on a disk and what only in memory, after some calls of a program below one folder."""

    def __init__(self, folder, root):
        self.folder, self.root = str(folder), os.path.join(str(folder), root)
        self.open = {}      # descriptor -> path of a folder, or number of a file
        self.appends = {}   # descriptor -> whether it writes at the end
        self.files = []     # number -> changes: bytes appended, or a size it was cut to
        self.safe = []      # number -> how many of them are on the disk for good
        self.names = {}     # path -> number, "folder"; as the program sees it
        self.changes = []   # [folder, on the disk for good, [(path, what or None), ...]]

    def path(self, text):
        return os.path.normpath(os.path.join(self.folder, text.decode()))

    def ours(self, path):
        return path == self.root or path.startswith(self.root + "/")

    def change(self, *pairs):
        for path, what in pairs:
            if what is None:
                self.names.pop(path, None)
            else:
                self.names[path] = what
        self.changes.append([os.path.dirname(pairs[-1][0]), False, list(pairs)])

    def opened(self, path, how, descriptor):
        what = self.names.get(path)
        self.open.pop(descriptor, None)
        if what is None and self.ours(path) and "O_CREAT" in how:
            what = len(self.files)
            self.files.append([])
            self.safe.append(0)
            self.change((path, what))
        if isinstance(what, int):
            if "O_TRUNC" in how and self.files[what]:
                self.files[what].append(0)
            self.open[descriptor] = what
        elif "O_DIRECTORY" in how:
            self.open[descriptor] = path

    def take(self, name, arguments, result):
        """Applies a call; True where it changes something below the folder, so that a crash before and after differ."""
        if result < 0:
            return False
        if name in ("openat", "open", "creat"):
            at = 1 if name == "openat" else 0
            before = len(self.changes)
            self.opened(self.path(arguments[at]), " ".join(str(one) for one in arguments[at + 1:]), result)
            return len(self.changes) > before
        if name == "close":
            self.open.pop(int(arguments[0]), None)
            return False
        if name in ("mkdir", "mkdirat"):
            path = self.path(arguments[1 if name == "mkdirat" else 0])
            if self.ours(path):
                self.change((path, "folder"))
            return self.ours(path)
        if name in ("unlink", "rmdir", "unlinkat"):
            path = self.path(arguments[1 if name == "unlinkat" else 0])
            if path in self.names:
                self.change((path, None))
                return True
            return False
        if name.startswith("rename"):
            old, new = [self.path(one) for one in arguments if isinstance(one, bytes)]
            if old in self.names:
                self.change((old, None), (new, self.names[old]))
                return True
            return False
        if name in ("dup", "dup2", "dup3"):
            if int(arguments[0]) in self.open:
                raise AssertionError(f"{name} of a file of the results is more than this model knows")
            return False
        if name == "truncate":
            raise AssertionError("truncate by name is more than this model knows")
        return self.change_file(name, arguments, result)

    def change_file(self, name, arguments, result):
        what = self.open.get(int(arguments[0]))
        if what is None:
            return False
        if name in ("fsync", "fdatasync"):
            if isinstance(what, int):
                self.safe[what] = len(self.files[what])
            else:
                for one in self.changes:
                    one[1] = one[1] or one[0] == what
            return True
        if not isinstance(what, int):
            return False
        if name == "write":
            self.files[what].append(arguments[1][:result])
        elif name == "ftruncate":
            self.files[what].append(int(arguments[1]))
        else:
            raise AssertionError(f"{name} is more than this model knows")
        return True

    def after_a_crash(self, kept_names, kept_data):
        """Path below the folder -> bytes, or None for a folder. `kept_names(changes not on the disk for good)` says how
        each of them ends; `kept_data(changes of a file that are not)` gives those that are kept."""
        pending = [one for one in self.changes if not one[1]]
        chosen = iter(kept_names(len(pending)))
        names = {}
        for _, good, pairs in self.changes:
            if not good and not next(chosen):
                continue
            for path, what in pairs:
                if what is None:
                    names.pop(path, None)
                else:
                    names[path] = what
        state = {}
        for path in sorted(names):
            if path != self.root and os.path.dirname(path) not in state:
                continue  # its folder is not there
            what = names[path]
            if what == "folder":
                state[path] = None
                continue
            content = b""
            changes, safe = self.files[what], self.safe[what]
            for one in changes[:safe]:
                content = content + one if isinstance(one, bytes) else content[:one]
            state[path] = kept_data(content, changes[safe:])
        return state


def every(count):
    return [True] * count


def none(count):
    return [False] * count


def all_data(content, changes):
    for one in changes:
        content = content + one if isinstance(one, bytes) else content[:one]
    return content


def no_data(content, changes):
    return content


def some_names(draw):
    """Those up to some one, as a journal of a file system leaves them, or any."""
    def choose(count):
        if draw.random() < 0.5:
            kept = draw.randint(0, count)
            return [k < kept for k in range(count)]
        return [draw.random() < 0.5 for _ in range(count)]
    return choose


def torn_data(draw):
    """Some of the changes, the last of them in part; or all of their size with blocks that were never written."""
    def tear(content, changes):
        if not changes:
            return content
        kept = changes[:draw.randint(0, len(changes))]
        whole = all_data(content, kept)
        begin = min(len(content), len(whole))
        if draw.random() < 0.5 and len(whole) > begin:
            return whole[:draw.randint(begin, len(whole))]
        blocks = bytearray(whole)
        for block in range(begin // BLOCK, len(whole) // BLOCK + 1):
            if draw.random() < 0.5:
                for k in range(max(begin, block * BLOCK), min(len(whole), (block + 1) * BLOCK)):
                    blocks[k] = 0
        return bytes(blocks)
    return tear
