#include "app/junit.h"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <initializer_list>
#include <sstream>
#include <utility>
#include <vector>

namespace froxel::app {
namespace {

using Tree = boost::property_tree::ptree;

using Attributes = std::initializer_list<std::pair<const char*, std::string>>;

Tree elementOf(const Attributes& attributes) {
    Tree named;
    for (const auto& [name, value] : attributes) {
        named.push_back({name, Tree(value)});
    }
    Tree element;
    element.push_back({"<xmlattr>", named});
    return element;
}

Tree elementOf(const std::string& class_name, const JunitCase& test) {
    Tree element = elementOf({{"classname", class_name}, {"name", test.name}});
    if (!test.failure.empty()) {
        element.push_back({"failure", elementOf({{"message", test.failure}})});
    }
    return element;
}

} // namespace

std::string
junitOf(const std::string& suite_name, const std::vector<JunitCase>& cases, double seconds) {
    std::string class_name = suite_name;
    std::ranges::replace(class_name, ' ', '.');
    const auto failures =
        std::ranges::count_if(cases, [](const JunitCase& test) { return !test.failure.empty(); });
    Tree suite = elementOf({{"name", suite_name},
                            {"tests", fmt::format("{}", cases.size())},
                            {"failures", fmt::format("{}", failures)},
                            {"time", fmt::format("{:.3f}", seconds)}});
    for (const JunitCase& test : cases) {
        suite.push_back({"testcase", elementOf(class_name, test)});
    }
    Tree suites;
    suites.push_back({"testsuite", suite});
    Tree all;
    all.push_back({"testsuites", suites});
    std::ostringstream text;
    boost::property_tree::write_xml(
        text, all, boost::property_tree::xml_writer_make_settings<std::string>(' ', 2));
    return text.str();
}

} // namespace froxel::app
