"""The checker finds what it is for."""

import shutil
import tempfile
import unittest
from pathlib import Path

from check_functions import functions, too_long

CTAGS = shutil.which("ctags-universal")
BODY = "    int a = 0;\n"


@unittest.skipUnless(CTAGS, "no Universal Ctags")
class CheckFunctions(unittest.TestCase):
    def found(self, text, name="a.cpp"):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, name).write_text(text)
            return list(functions(CTAGS, folder, [name]))

    def test_only_the_longer_one_is_named(self):
        text = "void f() {\n" + BODY * 58 + "}\nvoid g() {\n" + BODY * 59 + "}\n"
        self.assertEqual(list(too_long(self.found(text))), ["a.cpp:61: g has 61 lines; at most 60 are allowed"])

    def test_functions_of_every_kind_are_seen(self):
        for name, text in [
                ("a.cpp", "namespace n {\nResult<void>\nA::f(std::span<const int> x) const {\n}\n}"),
                ("a.cpp", "namespace {\nA::A(int x) : x_(x), y_{x} {\n    f();\n}\n}"),
                ("a.h", "template <class T>\nclass A {\n    [[nodiscard]] auto f() const override {\n    }\n};"),
                ("a.cpp", "TEST_F(A, B) {\n    const auto f = [&](int x) {\n    };\n}"),
                ("a.comp", "layout(local_size_x = 8) in;\nvoid main() {\n}")]:
            with self.subTest(text=text):
                names = [name for _, name, _, _ in self.found(text, name)]
                self.assertEqual(len([name for name in names if not name.startswith("__anon")]), 1)


if __name__ == "__main__":
    unittest.main()
