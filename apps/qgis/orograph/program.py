"""Runs the program as a process: its messages, its progress, its end. Knows nothing of QGIS."""

import codecs
import errno
import json
import os
import re
import selectors
import shutil
import subprocess
import time

PROGRAM_SETTING = "OROGRAPH_PROGRAM"

# What the program draws on a terminal while it works: [####......]  42 % what it does
PROGRESS = re.compile(r"^\[[#.]+\]\s+(\d+) % ?(.*)$")
SECONDS_BETWEEN_LOOKS = 0.1
SECONDS_TO_END = 10.0  # after the program was asked to; then it is ended


class ProgramFailed(Exception):
    """The program ended with an error: its last line, or what kept it from starting."""

    def __init__(self, line, exit_code=None):
        super().__init__(line)
        self.exit_code = exit_code


class Cancelled(Exception):
    """The user asked for an end, and the program has ended."""


def find_program(setting=""):
    """The program's path: that of the setting, of the variable OROGRAPH_PROGRAM, or orograph of PATH; or None."""
    for named in (setting, os.environ.get("OROGRAPH_PROGRAM", ""), "orograph"):
        if named:
            return shutil.which(os.path.expanduser(named))
    return None


def version_of(program):
    """The number of the program's version; "" where it does not tell."""
    try:
        told = subprocess.run([program, "--version"], capture_output=True, text=True, timeout=20, check=True)
    except (OSError, subprocess.SubprocessError):
        return ""
    found = re.search(r"\d+\.\d+\.\d+\S*", told.stdout)
    return found.group(0) if found else ""


class MessageLines:
    """Parts standard error of a terminal into lines, and tells progress from messages."""

    def __init__(self, say, progress):
        self.say, self.progress = say, progress
        self.decoder = codecs.getincrementaldecoder("utf-8")("replace")
        self.rest = ""
        self.last = ""

    def take(self, data, is_end=False):
        text = (self.rest + self.decoder.decode(data, is_end)).replace("\x1b[K", "")
        *lines, self.rest = re.split(r"[\r\n]", text)
        if is_end:
            lines.append(self.rest)
        for line in lines:
            self.line(line.strip())

    def line(self, line):
        drawn = PROGRESS.match(line)
        if drawn:
            self.progress(int(drawn.group(1)), drawn.group(2))
        elif line:
            self.last = line
            self.say(line)


def open_terminal():
    """The two ends of a terminal, on which the program shows its progress; or of a pipe, where there is none."""
    try:
        import pty

        return pty.openpty()
    except (ImportError, OSError):
        return os.pipe()


def read_some(file):
    """What is there to be read; b"" at the end, which a terminal tells by an error."""
    try:
        return os.read(file, 65536)
    except OSError as error:
        if error.errno == errno.EIO:
            return b""
        raise


def end(process):
    """Asks the program to end: it leaves no half-written file. Ends it where it does not. Not as Ctrl-C does: what was begun in
    the background of a shell, QGIS too, ignores that."""
    process.terminate()
    try:
        process.wait(SECONDS_TO_END)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def follow(process, streams, is_cancelled):
    """Reads both streams to their ends, or until the user cancels. streams: file to what takes its bytes."""
    with selectors.DefaultSelector() as selector:
        for file in streams:
            selector.register(file, selectors.EVENT_READ)
        while selector.get_map():
            for key, _ in selector.select(SECONDS_BETWEEN_LOOKS):
                data = read_some(key.fd)
                streams[key.fd](data)
                if not data:
                    selector.unregister(key.fd)
            if is_cancelled():
                end(process)
                raise Cancelled()


def run(program, words, say, progress, is_cancelled):
    """Runs the program with these words; gives what it wrote on standard output.

    say(line): a message of the program. progress(percent, what): how far it is. is_cancelled(): whether to end it.
    Raises ProgramFailed where it cannot be started or its exit code is not 0, and Cancelled.
    """
    ours, its = open_terminal()
    written = []
    lines = MessageLines(say, progress)
    try:
        process = subprocess.Popen(
            [program, *words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=its, start_new_session=True
        )
    except OSError as error:
        os.close(ours)
        raise ProgramFailed(f"{program}: cannot be started: {error.strerror}") from error
    finally:
        os.close(its)
    try:
        follow(
            process,
            {process.stdout.fileno(): written.append, ours: lambda data: lines.take(data, not data)},
            is_cancelled,
        )
        while process.poll() is None:
            if is_cancelled():
                end(process)
                raise Cancelled()
            time.sleep(SECONDS_BETWEEN_LOOKS)
    finally:
        if process.poll() is None:
            end(process)
        process.stdout.close()
        os.close(ours)
    if process.returncode != 0:
        raise ProgramFailed(lines.last or f"{program}: ended with {process.returncode}", process.returncode)
    return b"".join(written).decode("utf-8", "replace")


def report_of(text):
    """The JSON object that the program wrote; raises ProgramFailed where it is none."""
    try:
        return json.loads(text)
    except ValueError as error:
        raise ProgramFailed(f"the program's report is no JSON: {error}") from error
