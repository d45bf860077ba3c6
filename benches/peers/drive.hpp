// Feeds a peer the joint vectors that the kernels were given, compares what it returns with the
// textbook's results, and times it: the median of 41 rounds, nanoseconds of the processor's time per pose.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
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

inline double median(std::vector<double> times) {
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
}

// Nanoseconds of this process on a processor: other programs do not disturb them as much as the clock's.
inline double processor_time() {
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

// `call(q, w, out)` writes one pose's result, column by column. Timed twice: call after call, and each
// call waiting for the last.
template <class Call>
void drive(const std::string &directory, const char *peer, const char *output, size_t size, Call call) {
    for (const char *path : {"random", "smooth"}) {
        const std::string base = directory + "/" + path + ".";
        const auto q = read(base + "q"), w = read(base + "w"), expected = read(base + output);
        const size_t poses = q.size() / 6;
        std::vector<double> out(poses * size);
        for (size_t i = 0; i < poses; ++i) call(&q[6 * i], &w[6 * i], &out[size * i]);
        double scale = 0;
        for (double x : expected) scale = std::max(scale, std::fabs(x));
        for (size_t k = 0; k < out.size(); ++k) {
            if (!(std::fabs(out[k] - expected[k]) < 1e-12 * scale)) {
                std::fprintf(stderr, "%s %s: entry %zu is %.17g, not %.17g\n", peer, output, k, out[k],
                             expected[k]);
                std::exit(1);
            }
        }
        const auto each = [poses](double start) { return (processor_time() - start) / static_cast<double>(poses); };
        std::vector<double> times, serial;
        for (int round = 0; round < 41; ++round) {
            const double start = processor_time();
            // The results of 64 poses are written over and over, as for the kernels.
            for (size_t i = 0; i < poses; ++i) {
                call(&q[6 * i], &w[6 * i], &out[size * (i % 64)]);
                if (i % 64 == 63) asm volatile("" : : "r"(out.data()) : "memory");
            }
            times.push_back(each(start));
            const double again = processor_time();
            double last = 0, here[6];
            for (size_t i = 0; i < poses; ++i) {
                std::copy(&q[6 * i], &q[6 * i] + 6, here);
                here[0] += 0.0 * last;
                call(here, &w[6 * i], out.data());
                asm volatile("" : : "r"(out.data()) : "memory");
                last = out[5];
            }
            serial.push_back(each(again));
        }
        std::printf("%s %s %s %.1f\n", peer, output, path, median(times));
        std::printf("%s %s %s-serial %.1f\n", peer, output, path, median(serial));
    }
}

// The table of the KUKA KR 240-2, modified convention: a, alpha, d.
constexpr double TABLE[6][3] = {{0, 0, 0},         {0.35, M_PI_2, 0}, {1.25, 0, 0},
                                {0.055, -M_PI_2, 1.1}, {0, M_PI_2, 0},    {0, -M_PI_2, 0.23}};
// N·m/rad.
constexpr double STIFFNESS[6] = {3.8e6, 6.6e6, 3.9e6, 5.6e5, 6.6e5, 4.7e5};
