"""The checker finds what it is for."""

import tempfile
import unittest
from pathlib import Path

from check_layers import (check_built, check_committed, check_file, check_house, check_tree, check_wings,
                          dependencies, hints, wings)
from page_layers import check_circles, check_module, check_order

MAY_INCLUDE = {"core": set(), "view": {"core"}, "session": {"core", "view", "protocol"}, "render": {"gpu"},
               "gpu": {"core"}, "net": {"core"}, "load": {"core"}, "app": {"gpu"}, "stream": {"render"}, "protocol": set()}


MAY_IMPORT = {"core": [], "protocol": [], "state": ["core", "protocol"], "report": ["core"]}


def violations(layer, *lines, name="a.cpp"):
    return list(check_file(name, layer, lines, MAY_INCLUDE))


class CheckLayers(unittest.TestCase):
    def test_allowed_include_passes(self):
        self.assertEqual(violations("view", '#include "core/math.h"', '#include "view/a.h"'), [])

    def test_generated_messages_belong_to_protocol(self):
        include = '#include "froxel/v1/client.pb.h"'
        self.assertEqual(violations("session", include), [])
        self.assertEqual(len(violations("render", include)), 1)

    def test_forbidden_include_is_named(self):
        found = violations("session", "", '#include "render/view/renderer.h"')
        self.assertEqual(len(found), 1)
        self.assertIn("a.cpp:2: session may not include render", found[0])

    def test_table_of_layers_is_cmakes(self):
        rows = "| layer | what |\n| `server/core` | errors | nothing of ours |\n| `server/gpu` | the device | view |\n"
        found = list(check_house(rows, {"core": set(), "gpu": {"core"}, "net": {"core"}}))
        self.assertEqual([line.split()[1] for line in found], ["gpu", "net"])

    def test_dependencies_are_those_of_cmake(self):
        text = "froxel_layer(a\n    SOURCES a.cpp\n    DEPENDS core view\n            gpu\n    LIBRARIES B::b)\n"
        self.assertEqual(dependencies(text + "froxel_layer(a_b DEPENDS light)"), {"core", "view", "gpu", "light"})
        self.assertEqual(dependencies("add_library(froxel_core INTERFACE)"), set())

    def test_wings_are_those_of_cmake(self):
        text = "froxel_layer(a\n    WINGS low\n          high\n    SOURCES a.cpp\n    DEPENDS core)\n"
        self.assertEqual(wings(text), ["low", "high"])
        self.assertEqual(dependencies(text), {"core"})

    def test_include_between_wings_runs_down(self):
        for path, include, allowed in [("high/a.cpp", "a/low/b.h", True), ("low/b.cpp", "a/high/a.h", False),
                                       ("low/b.cpp", "a/c.h", False), ("low/b.cpp", "a/low/d.h", True),
                                       ("c.cpp", "a/high/a.h", True), ("low/b.cpp", "core/c.h", True)]:
            with self.subTest(path=path, include=include):
                found = list(check_wings("a", path, [f'#include "{include}"'], ["low", "high"]))
                self.assertEqual(len(found), 0 if allowed else 1)

    def test_include_of_no_layer_is_named(self):
        self.assertEqual(len(violations("view", '#include "math.h"')), 1)

    def test_sockets_outside_net(self):
        for layer in ("net", "load"):
            self.assertEqual(violations(layer, "#include <boost/beast/core.hpp>"), [])
        self.assertEqual(len(violations("app", "#include <boost/beast/core.hpp>")), 1)

    def test_vulkan_outside_gpu_and_render(self):
        self.assertEqual(violations("render", '#include "gpu/vulkan.h"'), [])
        self.assertEqual(len(violations("app", '#include "gpu/vulkan.h"')), 1)
        self.assertEqual(len(violations("app", "#include <vulkan/vulkan.h>")), 1)

    def test_bans(self):
        self.assertEqual(len(violations("core", "#include <iostream>")), 1)
        self.assertEqual(len(violations("tests", "out << std::endl;")), 1)
        self.assertEqual(len(violations("tests", "std::this_thread::sleep_for(1s);")), 1)
        self.assertEqual(violations("stream", "std::this_thread::sleep_for(1s);"), [])

    def test_header_without_guard(self):
        self.assertEqual(len(violations("core", "int a;", name="a.h")), 1)
        self.assertEqual(violations("core", "#pragma once", name="a.h"), [])

    def test_long_file_is_a_hint_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for layer in ("server/core", "protocol", "tests"):
                (root / layer).mkdir(parents=True)
                (root / layer / "CMakeLists.txt").write_text("")
            file = root / "server/core/a.cpp"
            file.write_text("\n" * 600)
            self.assertEqual(list(hints(root)), [])
            file.write_text("\n" * 601)
            self.assertEqual(list(hints(root)), ["hint: server/core/a.cpp: 601 lines; is it one matter?"])
            self.assertEqual(list(check_tree(root)), [])

    def test_unknown_folder_is_no_layer(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for layer in ("server/core", "server/util", "protocol", "tests"):
                (root / layer).mkdir(parents=True)
                if layer != "server/util":
                    (root / layer / "CMakeLists.txt").write_text("")
            self.assertEqual(len(list(check_tree(root))), 1)

    def test_table_of_the_pages_layers_is_its_own(self):
        rows = "| `protocol` | a layer of the server | core |\n| `client-web/src/state` | what | core, protocol |\n"
        found = list(check_house(rows, MAY_IMPORT, "client-web/(?:src/)?"))
        self.assertEqual([line.split()[1] for line in found], ["core", "protocol", "report"])

    def test_imports_of_the_page(self):
        for path, line, allowed in [
                ("src/state/a.ts", "import { b } from './b';", True),
                ("src/state/a.ts", "import type { Vec } from '../core/vec3';", True),
                ("src/state/a.ts", "} from '../gen/froxel/v1/common_pb';", True),
                ("src/core/a.ts", "} from '../gen/froxel/v1/common_pb';", False),
                ("src/core/a.ts", "import '../state/a';", False),
                ("src/core/a.ts", "const a = await import('../state/a');", False),
                ("src/core/a.ts", "new Worker(new URL('../state/a.ts', import.meta.url))", False),
                ("src/state/a.ts", "import { main } from '../main';", False),
                ("src/main.ts", "import { a } from './state/a';", True),
                ("src/core/a.ts", "import uPlot from 'uplot';", True),
                ("report/a.ts", "import { make } from '../src/core/dom';", True),
                ("report/a.ts", "import { Store } from '../src/state/store';", False)]:
            with self.subTest(path=path, line=line):
                found = list(check_module(path, ["", line], MAY_IMPORT))
                self.assertEqual([f"client-web/{path}:2" in each for each in found], [] if allowed else [True])

    def test_folder_of_the_page_that_is_no_layer(self):
        self.assertEqual(len(list(check_module("src/util/a.ts", [], MAY_IMPORT))), 1)

    def test_layers_of_the_page_in_a_circle(self):
        self.assertEqual(list(check_order(MAY_IMPORT)), [])
        self.assertEqual(len(list(check_order({"a": ["b"], "b": ["a"]}))), 1)
        self.assertEqual(len(list(check_order({"a": ["a"]}))), 1)

    def test_modules_of_the_page_in_a_circle(self):
        self.assertEqual(list(check_circles({"a": {"b", "c"}, "b": {"c"}, "c": {"elsewhere"}})), [])
        self.assertEqual(list(check_circles({"a": {"b"}, "b": {"c"}, "c": {"b"}, "d": {"d"}})),
                         ["client-web: b, c import one another", "client-web: d import one another"])

    def test_generated_code(self):
        built = ["protocol/a.pb.h", "client-web/src/gen/a_pb.ts", "shaders/a.spv"]
        self.assertEqual(len(list(check_committed(built + ["shaders/a.frag"]))), 3)

    def test_source_that_is_never_built(self):
        texts = {"a/CMakeLists.txt": "add(a b.cpp) fuzz(c)", "t/CMakeLists.txt": "${ROOT}/s/d.cpp"}
        sources = ["a/b.cpp", "a/u/c.cpp", "s/d.cpp", "a/bb.cpp", "s/e.cpp"]
        found = list(check_built([*texts, *sources], texts.get))
        self.assertEqual([line.split(":")[0] for line in found], ["a/bb.cpp", "s/e.cpp"])


if __name__ == "__main__":
    unittest.main()
