// Verdicts as test cases in JUnit's XML, as servers of continuous integration read them. Pure.
#pragma once

#include <string>
#include <vector>

namespace froxel::app {

struct JunitCase {
    std::string name;
    std::string failure; // why it failed; empty: it passed
};

// `suite`: "froxel load"; its words, joined by dots, are the class of each case. `seconds`: how
// long all of it took.
[[nodiscard]] std::string
junitOf(const std::string& suite, const std::vector<JunitCase>& cases, double seconds);

} // namespace froxel::app
