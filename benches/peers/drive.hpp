// Feeds a peer the joint vectors that the kernels were given, compares what it returns with the
// textbook's results, and times it: the median of 41 rounds, nanoseconds per pose.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

inline std::vector<double> read(const std::string &path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) {
        std::fprintf(stderr, "%s: cannot be read\n", path.c_str());
        std::exit(1);
    }
    std::vector<double> numbers(static_cast<size_t>(file.tellg()) / sizeof(double));
    file.seekg(0);
    file.read(reinterpret_cast<char *>(numbers.data()), numbers.size() * sizeof(double));
    return numbers;
}

// `call(q, out)` writes one pose's result, column by column.
template <class Call>
void drive(const std::string &directory, const char *peer, const char *output, size_t size, Call call) {
    for (const char *path : {"random", "smooth"}) {
        const std::string base = directory + "/" + path + ".";
        const auto q = read(base + "q"), expected = read(base + output);
        const size_t poses = q.size() / 6;
        std::vector<double> out(poses * size);
        for (size_t i = 0; i < poses; ++i) call(&q[6 * i], &out[size * i]);
        for (size_t k = 0; k < out.size(); ++k) {
            if (!(std::fabs(out[k] - expected[k]) < 1e-10)) {
                std::fprintf(stderr, "%s %s: entry %zu is %.17g, not %.17g\n", peer, output, k, out[k],
                             expected[k]);
                std::exit(1);
            }
        }
        std::vector<double> times;
        for (int round = 0; round < 41; ++round) {
            const auto start = std::chrono::steady_clock::now();
            for (size_t i = 0; i < poses; ++i) call(&q[6 * i], &out[size * i]);
            asm volatile("" : : "r"(out.data()) : "memory");
            const std::chrono::duration<double, std::nano> time =
                std::chrono::steady_clock::now() - start;
            times.push_back(time.count() / static_cast<double>(poses));
        }
        std::sort(times.begin(), times.end());
        std::printf("%s %s %s %.1f\n", peer, output, path, times[times.size() / 2]);
    }
}

// The table of the KUKA KR 240-2, modified convention: a, alpha, d.
constexpr double TABLE[6][3] = {{0, 0, 0},         {0.35, M_PI_2, 0}, {1.25, 0, 0},
                                {0.055, -M_PI_2, 1.1}, {0, M_PI_2, 0},    {0, -M_PI_2, 0.23}};
