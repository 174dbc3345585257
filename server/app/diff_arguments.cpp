#include "app/diff_arguments.h"

namespace froxel::app {

namespace {

constexpr settings::Range<double> kShareRange{"share", 0.0, 1.0};
constexpr settings::Range<double> kRmseRange{"max_rmse", 0.0, 1e6};
constexpr settings::Range<double> kToleranceRange{"tolerance", 0.0, 1e6};

} // namespace

void addDiffArguments(CommandBuilder& command, DiffOptions& options) {
    command
        .text("A", "PICTURE|FOLDER", options.picture, "",
              "PNG, JPEG, OpenEXR or PFM file, or a folder of them")
        ->required();
    command
        .text("B", "PICTURE|FOLDER", options.reference, "",
              "Reference: a file of the same size, or a folder with the same names")
        ->required();
    command.number("--max-flip", options.limits.max_flip, kShareRange, "none",
                   "Highest mean LDR-FLIP of a pair, of OpenEXR and PFM HDR-FLIP");
    command.number("--max-rmse", options.limits.max_rmse, kRmseRange, "none",
                   "Highest RMSE of a pair: of colours from 0 to 1, or of radiance");
    command.number("--max-differing", options.limits.max_differing, kShareRange,
                   "0 without another limit", "Highest share of a pair's pixels that differ");
    command.number("--tolerance", options.limits.tolerance, kToleranceRange,
                   "Difference of a channel up to which a pixel counts as equal: in 1/255 steps "
                   "of colours, or in radiance");
    command.group("Limits");
    command.text("--out", "DIR", options.out, "",
                 "Folder for a heat map of FLIP for each pair that is not equal: NAME.flip.png");
    command.text("--report", "FILE", options.report, "",
                 "HTML with the pictures side by side, in one file");
    command.text("--json", "FILE|-", options.json, "",
                 "File for all figures, as JSON; -: standard output, with the table on stderr");
    command.text("--junit", "FILE", options.junit, "",
                 "File for the pairs as test cases, in JUnit's XML");
    command.text("--web-root", "DIR", options.web_root, "web beside the binary, else the build's",
                 "Folder of the built page, for --report");
    command.group("Results");
}

} // namespace froxel::app
