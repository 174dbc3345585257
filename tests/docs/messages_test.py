import unittest

from messages import messages


class Messages(unittest.TestCase):
    def test_adjacent_literals_are_one_message_where_the_first_begins(self):
        source = 'int a;\nsay("the scene has no "\n    "camera of this name");\n'
        self.assertEqual(list(messages("a.cpp", source)), [(1, "the scene has no camera of this name")])

    def test_holes_are_words_and_lines_are_parted(self):
        source = 'say("the light {} has no position\\nthe light {:.3g} is too far away");\n'
        self.assertEqual([text for _, text in messages("a.cpp", source)],
                         ["the light N has no position", "the light N is too far away"])

    def test_page_and_markup(self):
        self.assertEqual([text for _, text in messages("a.ts", "say(`no frame within ${seconds} s of this`);")],
                         ["no frame within N s of this"])
        self.assertEqual([text for _, text in messages("a.html", '<p title="Copy a link to this view">x</p>')],
                         ["Copy a link to this view"])

    def test_short_texts_comments_and_code_are_none(self):
        for source in ("// \"this is only a comment here\"", 'f("two words");', 'f("https://example.org/a b c d");',
                       'glsl("void main() { color = vec4(one, two); }");'):
            self.assertEqual(list(messages("a.cpp", source)), [], source)


if __name__ == "__main__":
    unittest.main()
