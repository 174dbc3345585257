// Runs a fuzz target without libFuzzer: every file of a folder, then mutations of them, always the
// same. What it was at when it crashed lies in finding.bin of the working directory.
//
// Usage: fuzz_NAME_replay CORPUS MUTATIONS
#include "fuzz/target.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <unistd.h>
#include <vector>

namespace froxel::fuzz {
namespace {

constexpr size_t kMaxBytes = size_t{64} * 1024; // as libFuzzer in deploy/fuzz.sh

std::string current;

extern "C" void keepFinding(int signal) {
    const int file = open("finding.bin", O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    const ssize_t written = file < 0 ? -1 : write(file, current.data(), current.size());
    static_cast<void>(written);
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

std::vector<std::string> readCorpus(const char* folder) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    std::vector<std::string> corpus;
    for (const auto& path : paths) {
        std::ifstream in(path, std::ios::binary);
        corpus.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    return corpus;
}

void run(std::string input) {
    current = std::move(input);
    LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t*>(current.data()), current.size());
}

using Random = std::mt19937;

// The remainder of a draw is not quite even, but the same with every library.
size_t below(Random& random, size_t bound) {
    return random() % bound;
}

std::string partOf(const std::string& text, Random& random) {
    const size_t begin = below(random, text.size() + 1);
    return text.substr(begin, below(random, 64));
}

std::string mutated(std::string bytes, const std::string& other, Random& random) {
    for (size_t edits = 1 + below(random, 4); edits > 0; --edits) {
        const size_t at = below(random, bytes.size() + 1);
        const auto value = static_cast<char>(below(random, 256));
        switch (below(random, 6)) {
        case 0:
            bytes.insert(at, 1, value);
            break;
        case 1:
            bytes.resize(at);
            break;
        case 2:
            bytes.insert(at, partOf(other, random));
            break;
        case 3:
            bytes.erase(at, below(random, 8));
            break;
        case 4:
            if (at < bytes.size()) {
                bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(random, 8)));
            }
            break;
        default:
            if (at < bytes.size()) {
                bytes[at] = value;
            }
        }
    }
    bytes.resize(std::min(bytes.size(), kMaxBytes));
    return bytes;
}

int replay(const char* folder, int rounds) {
    for (const int signal : std::array{SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) {
        std::signal(signal, &keepFinding);
    }
    const std::vector<std::string> corpus = readCorpus(folder);
    if (corpus.empty()) {
        std::fprintf(stderr, "%s has no files\n", folder);
        return EXIT_FAILURE;
    }
    run("");
    for (const std::string& input : corpus) {
        run(input);
    }
    Random random(1);
    for (int i = 0; i < rounds; ++i) {
        const std::string& from = corpus[below(random, corpus.size())];
        const std::string& other = corpus[below(random, corpus.size())];
        run(mutated(from, other, random));
    }
    std::printf("%zu files and %d mutations of them\n", corpus.size(), rounds);
    return EXIT_SUCCESS;
}

} // namespace
} // namespace froxel::fuzz

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: %s CORPUS MUTATIONS\n", argv[0]);
        return 2;
    }
    return froxel::fuzz::replay(argv[1], std::atoi(argv[2]));
}
