// The header to vendor against the Rust reader: cells_header CELLS [POINTS [MUTATIONS]].
//
// Both say the same of every point that lies on no edge; on an edge either cell will do, so that there neither may
// contradict the other. A file that was damaged at random is refused or answers something, but never astray: the test
// runs under AddressSanitizer. What the Rust reader accepts the header accepts.

#include "spiral_atlas_cells.hpp"

#include "check.hpp"

#include <spiral_atlas.h>

#include <chrono>
#include <cstdio>
#include <random>

using spiral_atlas::CellsFile;

static std::vector<unsigned char> bytes_of(const std::string &path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

int main(int count, char **arguments) {
    CHECK(count >= 2);
    const std::string path = arguments[1];
    const std::size_t points = count > 2 ? std::strtoull(arguments[2], nullptr, 10) : 1'000'000;
    const std::size_t mutations = count > 3 ? std::strtoull(arguments[3], nullptr, 10) : 0;
    const CellsFile cells(path);
    SpiralCells *rust = nullptr;
    CHECK(spiral_cells_open(path.c_str(), &rust) == SPIRAL_OK && spiral_cells_axes(rust) == cells.axes());
    const std::size_t n = cells.axes();
    std::mt19937_64 random(7);
    const auto edge = [&](std::size_t axis) {
        // Where the edges are, the file says: a linear axis, or a logarithmic one.
        const double share =
            static_cast<double>(random() % (cells.resolution() + 1)) / static_cast<double>(cells.resolution());
        const double linear = cells.low(axis) + share * (cells.high(axis) - cells.low(axis));
        const double log = cells.low(axis) * std::pow(cells.high(axis) / cells.low(axis), share);
        return random() % 2 == 0 ? linear : log;
    };
    std::vector<double> all;
    for (std::size_t i = 0; i < points; i++)
        for (std::size_t axis = 0; axis < n; axis++) {
            const double low = cells.low(axis), high = cells.high(axis);
            const double x = low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
            switch (random() % 64) {
            case 0: all.push_back(edge(axis)); break;
            case 1: all.push_back(std::nextafter(edge(axis), random() % 2 == 0 ? high : low)); break;
            case 2: all.push_back(random() % 2 == 0 ? low : high); break;
            case 3: all.push_back(random() % 8 != 0 ? x : std::nextafter(low, -1e300)); break;
            case 4: all.push_back(random() % 8 != 0 ? x : std::nan("")); break;
            case 5: all.push_back(random() % 8 != 0 ? x : std::numeric_limits<double>::infinity()); break;
            default: all.push_back(x);
            }
        }
    std::vector<std::uint8_t> inside(points), outside(points);
    CHECK(spiral_cells_lookup(rust, all.data(), points, inside.data(), outside.data()) == SPIRAL_OK);
    std::size_t differ = 0, known = 0;
    for (std::size_t i = 0; i < points; i++) {
        const auto said = cells.lookup_all(&all[n * i]);
        CHECK((said.inside & outside[i]) == 0 && (said.outside & inside[i]) == 0 && (said.inside & said.outside) == 0);
        differ += said.inside != inside[i] || said.outside != outside[i];
        known += (said.inside | said.outside) != 0;
        for (std::size_t bit = 0; i < 1000 && bit < cells.flags().size(); bit++) {
            const auto one = cells.lookup(&all[n * i], static_cast<std::uint8_t>(1u << bit));
            CHECK((one == spiral_atlas::Cell::inside) == ((said.inside >> bit & 1) != 0));
            CHECK((one == spiral_atlas::Cell::outside) == ((said.outside >> bit & 1) != 0));
        }
    }
    // Only on edges, of which one coordinate in 64 may be one.
    CHECK(differ * 50 < points && known * 2 > points);
    const auto time = [&](auto &&lookup) {
        const auto started = std::chrono::steady_clock::now();
        lookup();
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - started;
        return taken.count() / static_cast<double>(points) * 1e9;
    };
    unsigned sum = 0;
    const std::uint8_t spiral = cells.flag("SPIRAL");
    const double own = time([&] {
        for (std::size_t i = 0; i < points; i++) sum += static_cast<unsigned>(cells.lookup(&all[n * i], spiral));
    });
    const double every =
        time([&] { for (std::size_t i = 0; i < points; i++) sum += cells.lookup_all(&all[n * i]).inside; });
    const double theirs = time([&] { spiral_cells_lookup(rust, all.data(), points, inside.data(), outside.data()); });
    std::printf("%zu points, %zu on edges differ; ns a point: one flag %.1f, all flags %.1f, C interface %.1f (%u)\n",
                points, differ, own, every, theirs, sum % 10);
    spiral_cells_close(rust);

    const std::vector<unsigned char> sound = bytes_of(path);
    std::size_t refused = 0, accepted = 0;
    for (std::size_t i = 0; i < mutations; i++) {
        std::vector<unsigned char> damaged = sound;
        const std::size_t header = 8 + sound[0] + 256u * sound[1];
        for (std::size_t k = 0; k <= random() % 3; k++) {
            // The header above all, where lengths and shapes are.
            const std::size_t at = random() % (random() % 2 == 0 ? header : damaged.size());
            damaged[at] = static_cast<unsigned char>(random() % 2 == 0 ? random() : damaged[at] ^ 1u << random() % 8);
        }
        if (random() % 16 == 0) damaged.resize(random() % damaged.size());
        const std::string place = path + ".damaged";
        std::ofstream(place, std::ios::binary).write(reinterpret_cast<const char *>(damaged.data()),
                                                     static_cast<std::streamsize>(damaged.size()));
        const bool sound_for_rust = spiral_cells_open(place.c_str(), &rust) == SPIRAL_OK;
        try {
            const CellsFile read(damaged.data(), damaged.size()), mapped(place);
            for (std::size_t k = 0; k < 20 && read.axes() == n; k++) {
                const double *point = &all[n * (random() % points)];
                const auto said = read.lookup_all(point), again = mapped.lookup_all(point);
                CHECK((said.inside & said.outside) == 0 && said.inside == again.inside &&
                      said.outside == again.outside);
                std::uint8_t yes = 0, no = 0;
                if (!sound_for_rust) continue;
                CHECK(spiral_cells_lookup(rust, point, 1, &yes, &no) == SPIRAL_OK && (yes & said.outside) == 0 &&
                      (no & said.inside) == 0);
            }
        } catch (const std::runtime_error &) {
            CHECK(!sound_for_rust);
            refused++;
        }
        if (sound_for_rust) spiral_cells_close(rust);
        accepted += sound_for_rust;
        std::remove(place.c_str());
    }
    if (mutations > 0) {
        std::printf("%zu damaged files, %zu refused; Rust accepts %zu\n", mutations, refused, accepted);
        CHECK(refused * 4 > mutations && accepted > 0);
    }
    return 0;
}
