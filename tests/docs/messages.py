"""Writes what the program says to people as text files for the checks of language.

Usage: messages.py ROOT OUT FILE... Each FILE below ROOT is C++, TypeScript, HTML or protobuf. OUT/FILE.txt has as many
lines as FILE, and on each line the messages that begin there: string literals of at least four words (adjacent C++
literals joined), text between HTML tags. So a complaint about a line of OUT/FILE.txt is one about that line of FILE.
"""

import re
import sys
from pathlib import Path

LEAST_WORDS = 4
COMMENT = re.compile(r"(?<![:\"'\w])//[^\n]*|/\*.*?\*/", re.S)
CPP = re.compile(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*')
PAGE = re.compile(r"'(?:[^'\\\n]|\\.)*'|\"(?:[^\"\\\n]|\\.)*\"|`(?:[^`\\]|\\.)*`")
HTML = re.compile(r'(?<=>)[^<>{}]+(?=<)|(?<=title=)"[^"]*"|(?<=aria-label=)"[^"]*"')
WORD = re.compile(r"(?<![\w./-])[A-Za-z][a-z']*(?![\w/=(-])")
# Code of another language in a literal: shaders, HTML, regular expressions, addresses, CSS.
FOREIGN = re.compile(r"[{};]\s*$|^\s*[<#^]|=>|::|\$\{[^}]*\(|https?://\S+$|^[\w-]+:[^ ]|\\[dws]")
HOLE = re.compile(r"\$\{[^}]*\}|\{[^{}]*\}")


def blank(match):
    """Spaces in place of a comment; its line breaks stay."""
    return re.sub(r"[^\n]", " ", match[0])


def lines_of(literal, cpp):
    """The lines that a literal, or adjacent ones, print."""
    if cpp:
        literal = re.sub(r'"\s*"', "", literal)
    text = literal.strip("\"'`").replace("\\\"", '"').replace("\\'", "'").replace("\\t", " ")
    return [re.sub(r"\s+", " ", HOLE.sub("N", line)).strip() for line in text.split("\\n")]


def messages(name, text):
    """(line from 0, message) of each message of a source file."""
    html = name.endswith(".html")
    text = text if html else COMMENT.sub(blank, text)
    cpp = name.endswith((".cpp", ".h"))
    pattern = HTML if html else CPP if cpp else PAGE
    for match in pattern.finditer(text):
        begin = text.count("\n", 0, match.start())
        for number, message in enumerate(lines_of(match[0], cpp)):
            if len(WORD.findall(message)) >= LEAST_WORDS and not FOREIGN.search(message):
                yield begin + number, message


def main():
    root, out = Path(sys.argv[1]), Path(sys.argv[2])
    for name in sys.argv[3:]:
        text = (root / name).read_text(encoding="utf-8")
        lines = [""] * (text.count("\n") + 1)
        for line, message in messages(name, text):
            while line < len(lines) - 1 and lines[line]:
                line += 1
            lines[line] = message
        if any(lines):
            path = out / f"{name}.txt"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
