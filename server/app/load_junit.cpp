#include "app/load_junit.h"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <spdlog/fmt/fmt.h>

#include <cstddef>
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

Tree caseOf(const std::string& name, const std::string& failure) {
    Tree test = elementOf({{"classname", "froxel.load"}, {"name", name}});
    if (!failure.empty()) {
        test.push_back({"failure", elementOf({{"message", failure}})});
    }
    return test;
}

} // namespace

std::string junitOf(const LoadVerdict& verdict, double seconds) {
    std::vector<Tree> cases = {caseOf("no viewer fails", verdict.failure.value_or(""))};
    size_t failures = verdict.failure ? 1 : 0;
    for (const load::Outcome& outcome : verdict.outcomes) {
        cases.push_back(caseOf(outcome.requirement, outcome.held ? "" : load::wordsOf(outcome)));
        failures += outcome.held ? 0 : 1;
    }
    Tree suite = elementOf({{"name", "froxel load"},
                            {"tests", fmt::format("{}", cases.size())},
                            {"failures", fmt::format("{}", failures)},
                            {"time", fmt::format("{:.3f}", seconds)}});
    for (Tree& test : cases) {
        suite.push_back({"testcase", std::move(test)});
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
