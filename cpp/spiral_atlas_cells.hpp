/* Certified cells in one header: C++17, no library, no Rust. Copy it into your project.
 *
 *     spiral_atlas::CellsFile cells("cells.atlas.safetensors");
 *     const double point[] = {0.7, 1.4, 0.4, 4.0};
 *     switch (cells.lookup(point, cells.flag("SPIRAL"))) {
 *         case spiral_atlas::Cell::inside:  ... // proved: it holds at every point of the cell
 *         case spiral_atlas::Cell::outside: ... // proved: it holds at none
 *         case spiral_atlas::Cell::mixed:   ... // not known here: ask the library, or another point
 *     }
 *
 * The constructor maps the file (POSIX; elsewhere it is read) and checks all that lookups rely on, so that no file can
 * lead them astray. It throws std::runtime_error, which names the file and what is wrong. Lookups allocate nothing,
 * throw nothing, and may run in any number of threads at once. The hashes in the file are not checked: a damaged file
 * that is still sound is not noticed. docs/cells.md states the format byte by byte.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0 */

#ifndef SPIRAL_ATLAS_CELLS_HPP
#define SPIRAL_ATLAS_CELLS_HPP

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#if defined(__unix__) || defined(__APPLE__)
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#define SPIRAL_ATLAS_CELLS_MMAP 1
#endif

namespace spiral_atlas {

/// What a cell says of a flag.
enum class Cell : std::uint8_t { mixed, inside, outside };

namespace cells_detail {

inline unsigned ones(std::uint32_t x) noexcept {
#if defined(__GNUC__) || defined(__clang__)
    return static_cast<unsigned>(__builtin_popcount(x));
#else
    unsigned count = 0;
    for (; x != 0; x &= x - 1) count++;
    return count;
#endif
}

/// A JSON value: as much of it as headers have.
struct Json {
    enum class Kind { other, text, list, object } kind = Kind::other;
    std::string text; ///< of a text; of a number its digits
    std::vector<std::pair<std::string, Json>> items; ///< of a list (without names) or an object

    const Json *find(const std::string &name) const {
        for (const auto &item : items)
            if (item.first == name) return &item.second;
        return nullptr;
    }
};

/// Reads one JSON text. It throws const char *.
class JsonReader {
public:
    explicit JsonReader(const std::string &text) : at_(text.data()), end_(text.data() + text.size()) {}

    Json whole() {
        Json value = read(0);
        skip();
        if (at_ != end_) throw "its header goes on after the end";
        return value;
    }

private:
    const char *at_, *end_;

    void skip() {
        while (at_ != end_ && (*at_ == ' ' || *at_ == '\n' || *at_ == '\r' || *at_ == '\t')) at_++;
    }

    char next() {
        if (at_ == end_) throw "its header ends too early";
        return *at_++;
    }

    bool take(char wanted) {
        skip();
        if (at_ == end_ || *at_ != wanted) return false;
        at_++;
        return true;
    }

    Json read(int depth) {
        if (depth > 8) throw "its header is nested too deeply";
        Json value;
        skip();
        if (take('{')) {
            value.kind = Json::Kind::object;
            if (take('}')) return value;
            do {
                skip();
                std::string name = text();
                if (!take(':')) throw "its header has a name without a value";
                value.items.emplace_back(std::move(name), read(depth + 1));
            } while (take(','));
            if (!take('}')) throw "its header has an object without an end";
        } else if (take('[')) {
            value.kind = Json::Kind::list;
            if (take(']')) return value;
            do value.items.emplace_back(std::string(), read(depth + 1));
            while (take(','));
            if (!take(']')) throw "its header has a list without an end";
        } else if (at_ != end_ && *at_ == '"') {
            value.kind = Json::Kind::text;
            value.text = text();
        } else {
            while (at_ != end_ && std::strchr("+-.0123456789Eaeflnrstu", *at_) != nullptr && *at_ != '\0')
                value.text += *at_++;
            if (value.text.empty()) throw "its header is no JSON";
        }
        return value;
    }

    std::string text() {
        if (next() != '"') throw "its header is no JSON";
        std::string all;
        for (char c = next(); c != '"'; c = next()) {
            if (c != '\\') {
                all += c;
                continue;
            }
            switch (c = next()) {
            case 'n': all += '\n'; break;
            case 't': all += '\t'; break;
            case 'r': all += '\r'; break;
            case 'b': all += '\b'; break;
            case 'f': all += '\f'; break;
            case 'u': // Names have no such letters, and nothing else is looked at.
                for (int i = 0; i < 4; i++) next();
                all += '?';
                break;
            default: all += c;
            }
        }
        return all;
    }
};

/// The bytes of a file.
class Bytes {
public:
    Bytes() = default;

    explicit Bytes(const std::string &path) {
#ifdef SPIRAL_ATLAS_CELLS_MMAP
        const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
        if (file < 0) throw "it cannot be opened";
        struct stat about {};
        const bool known = ::fstat(file, &about) == 0 && S_ISREG(about.st_mode) && about.st_size > 0;
        void *map = MAP_FAILED;
        if (known) map = ::mmap(nullptr, static_cast<std::size_t>(about.st_size), PROT_READ, MAP_PRIVATE, file, 0);
        ::close(file);
        if (map == MAP_FAILED) throw "it cannot be mapped into memory, or is empty or no file";
        const auto size = static_cast<std::size_t>(about.st_size);
        owner_ = std::shared_ptr<const void>(map,
                                             [size](const void *first) { ::munmap(const_cast<void *>(first), size); });
        data_ = static_cast<const unsigned char *>(map);
        size_ = size;
#else
        std::ifstream file(path, std::ios::binary);
        if (!file) throw "it cannot be opened";
        auto all = std::make_shared<std::vector<unsigned char>>(std::istreambuf_iterator<char>(file),
                                                                std::istreambuf_iterator<char>());
        data_ = all->data();
        size_ = all->size();
        owner_ = all;
#endif
    }

    Bytes(const void *data, std::size_t size) {
        const auto *first = static_cast<const unsigned char *>(data);
        auto all = std::make_shared<std::vector<unsigned char>>(first, first + size);
        data_ = all->data();
        size_ = size;
        owner_ = all;
    }

    const unsigned char *data() const noexcept { return data_; }
    std::size_t size() const noexcept { return size_; }

private:
    std::shared_ptr<const void> owner_;
    const unsigned char *data_ = nullptr;
    std::size_t size_ = 0;
};

inline std::uint32_t word(const unsigned char *at) noexcept {
    return static_cast<std::uint32_t>(at[0]) | static_cast<std::uint32_t>(at[1]) << 8 |
           static_cast<std::uint32_t>(at[2]) << 16 | static_cast<std::uint32_t>(at[3]) << 24;
}

inline std::uint64_t long_word(const unsigned char *at) noexcept {
    return word(at) | static_cast<std::uint64_t>(word(at + 4)) << 32;
}

inline double number(const unsigned char *at) noexcept {
    const std::uint64_t bits = long_word(at);
    double x;
    std::memcpy(&x, &bits, sizeof x);
    return x;
}

/// Increasing edges, and which of the cells between them holds a number.
///
/// Numbers are sorted into buckets by a key that never falls while they rise. An edge with a smaller key is below every
/// number of a bucket, and one with a larger key above, so that few edges are left to compare.
class Axis {
public:
    Axis(std::string name, std::vector<double> edges, bool log) : name_(std::move(name)), edges_(std::move(edges)) {
        low_ = edges_.front();
        high_ = edges_.back();
        log_ = log && low_ > 0;
        const std::size_t buckets = 4 * edges_.size();
        first_ = position(low_);
        // In (0, inf): finite ends that differ, halved against overflow.
        const double range = position(high_) - first_;
        scale_ = static_cast<double>(buckets) / range;
        if (!(scale_ > 0) || std::isinf(scale_)) scale_ = 0;
        ranges_.resize(buckets + 1);
        const std::size_t last = edges_.size() - 1;
        std::size_t below = 0, above = 0;
        for (std::size_t b = 0; b <= buckets; b++) {
            while (below < last - 1 && key(edges_[below + 1]) < b) below++;
            while (above < last && key(edges_[above]) <= b) above++;
            ranges_[b] = {static_cast<std::uint16_t>(below), static_cast<std::uint16_t>(above)};
        }
    }

    /// An axis of one value, at which all cells lie.
    Axis(std::string name, double only) : name_(std::move(name)), edges_{only}, low_(only), high_(only) {}

    const std::string &name() const noexcept { return name_; }
    bool single() const noexcept { return edges_.size() == 1; }
    double low() const noexcept { return low_; }
    double high() const noexcept { return high_; }
    std::size_t cells() const noexcept { return edges_.size() - 1; }

    /// The cell that holds x, or cells() outside and for NaN.
    std::size_t find(double x) const noexcept {
        if (!(low_ <= x && x <= high_)) return cells();
        auto [below, above] = ranges_[key(x)];
        while (above - below > 1) {
            const auto middle = static_cast<std::uint16_t>((below + above) / 2);
            (x >= edges_[middle] ? below : above) = middle;
        }
        return below;
    }

private:
    /// Of a number within the ends: it never falls while x rises. The bits of positive doubles rise like their
    /// logarithm.
    double position(double x) const noexcept {
        if (!log_) return 0.5 * x;
        std::uint64_t bits;
        std::memcpy(&bits, &x, sizeof bits);
        return static_cast<double>(bits >> 1);
    }

    std::size_t key(double x) const noexcept {
        const double at = (position(x) - first_) * scale_;
        const double most = static_cast<double>(ranges_.empty() ? 4 * edges_.size() : ranges_.size() - 1);
        return static_cast<std::size_t>(at < most ? (at > 0 ? at : 0) : most);
    }

    std::string name_;
    std::vector<double> edges_;
    double low_ = 0, high_ = 0, first_ = 0, scale_ = 0;
    bool log_ = false;
    /// Of each bucket the last edge that is below all its numbers, and the first that is above.
    std::vector<std::pair<std::uint16_t, std::uint16_t>> ranges_;
};

} // namespace cells_detail

/// A file of certified cells.
class CellsFile {
public:
    /// Most axes that a file has.
    static constexpr std::size_t most_axes = 5;
    /// Most of them with several values.
    static constexpr std::size_t most_divided = 4;

    /// What a cell says of all flags: two masks, and a flag in neither is not known.
    struct Known {
        std::uint8_t inside = 0, outside = 0;
    };

    explicit CellsFile(const std::string &path) : path_(path) {
        try {
            bytes_ = cells_detail::Bytes(path);
            read();
        } catch (const char *what) {
            throw std::runtime_error(path + ": " + what);
        }
    }

    /// A copy of the bytes of a file.
    CellsFile(const void *data, std::size_t size) : path_("(memory)") {
        try {
            bytes_ = cells_detail::Bytes(data, size);
            read();
        } catch (const char *what) {
            throw std::runtime_error(path_ + ": " + what);
        }
    }

    const std::string &path() const noexcept { return path_; }
    const std::string &family() const noexcept { return family_; }
    std::size_t axes() const noexcept { return axes_.size(); }
    const std::string &axis_name(std::size_t i) const { return axes_.at(i).name(); }
    double low(std::size_t i) const { return axes_.at(i).low(); }
    double high(std::size_t i) const { return axes_.at(i).high(); }
    /// Cells along each axis of several values.
    std::size_t resolution() const noexcept { return std::size_t{1} << depth_; }
    /// Names of the flags, bit 0 first.
    const std::vector<std::string> &flags() const noexcept { return flags_; }

    /// The mask of a flag; it throws std::out_of_range for an unknown name.
    std::uint8_t flag(const std::string &name) const {
        for (std::size_t bit = 0; bit < flags_.size(); bit++)
            if (flags_[bit] == name) return static_cast<std::uint8_t>(1u << bit);
        throw std::out_of_range(path_ + " has no flag " + name);
    }

    /// What the cell of a point (axes() coordinates) says of one flag, given by its mask. Outside the box it is mixed.
    Cell lookup(const double *point, std::uint8_t flag) const noexcept {
        const Known known = lookup_all(point, flag);
        return (known.inside & flag) != 0 ? Cell::inside : (known.outside & flag) != 0 ? Cell::outside : Cell::mixed;
    }

    /// What the cell of a point says of the wanted flags. Outside the box nothing is known.
    Known lookup_all(const double *point, std::uint8_t wanted = 255) const noexcept {
        const std::size_t n = divided_;
        const unsigned shift = depth_ - top_;
        const std::size_t within = (std::size_t{1} << shift) - 1;
        std::size_t at = 0;
        // The number of the child at each level, the finest in the lowest bits.
        std::uint64_t way = 0;
        for (std::size_t i = 0; i < axes_.size(); i++) {
            if (axes_[i].single()) {
                if (!(point[i] == axes_[i].low())) return {};
                continue;
            }
            const std::size_t cell = axes_[i].find(point[i]);
            if (cell == axes_[i].cells()) return {};
            at = at << top_ | cell >> shift;
            way = way << 1 | spread_[cell & within];
        }
        const unsigned char *both = known_ + 2 * at;
        Known known{static_cast<std::uint8_t>(both[0] & wanted), static_cast<std::uint8_t>(both[1] & wanted)};
        unsigned open = wanted & ~static_cast<unsigned>(both[0] | both[1]) & ((1u << flags_.size()) - 1);
        for (unsigned bit = 0; open != 0; bit++, open >>= 1) {
            if ((open & 1) == 0) continue;
            std::size_t node = cells_detail::word(roots_ + 4 * (at * flags_.size() + bit));
            for (unsigned size = shift; node != 0 && size-- > 0;) {
                const auto child = static_cast<unsigned>(way >> (size * n) & ((1u << n) - 1));
                const std::uint32_t word = cells_detail::word(trees_ + 4 * node);
                if ((word >> child & 1) != 0) known.inside = static_cast<std::uint8_t>(known.inside | 1u << bit);
                if ((word >> (16 + child) & 1) != 0)
                    known.outside = static_cast<std::uint8_t>(known.outside | 1u << bit);
                if (((word | word >> 16) >> child & 1) != 0 || size == 0) break;
                const std::uint32_t next = cells_detail::word(trees_ + 4 * (node + 1));
                const unsigned before = cells_detail::ones(~(word | word >> 16) & ((1u << child) - 1));
                node = next == 0 ? 0 : next + std::size_t{before} * words(size - 1);
            }
        }
        return known;
    }

private:
    /// Words of a node whose children are 2^size finest cells wide.
    static std::size_t words(unsigned size) noexcept { return size == 0 ? 1 : 2; }

    struct Tensor {
        std::string type;
        std::vector<std::size_t> shape;
        std::size_t begin = 0, end = 0;
    };

    static std::size_t whole(const cells_detail::Json &value) {
        if (value.kind != cells_detail::Json::Kind::other || value.text.empty() || value.text.size() > 15)
            throw "its header has a wrong number";
        std::size_t sum = 0;
        for (const char c : value.text) {
            if (c < '0' || c > '9') throw "its header has a wrong number";
            sum = 10 * sum + static_cast<std::size_t>(c - '0');
        }
        return sum;
    }

    static const std::string &text(const cells_detail::Json &object, const char *name) {
        const cells_detail::Json *value = object.find(name);
        if (value == nullptr || value->kind != cells_detail::Json::Kind::text) throw "its metadata lack an entry";
        return value->text;
    }

    /// The tensor of a name, which must have this type and shape (0: of any size) and lie within the file.
    const unsigned char *tensor(const cells_detail::Json &header, const std::string &name, const char *type,
                                std::size_t width, std::vector<std::size_t> &shape) const {
        const cells_detail::Json *about = header.find(name);
        if (about == nullptr) throw "a tensor is missing";
        const cells_detail::Json *sizes = about->find("shape"), *offsets = about->find("data_offsets");
        if (text(*about, "dtype") != type || sizes == nullptr || offsets == nullptr || offsets->items.size() != 2)
            throw "a tensor has a wrong type";
        if (sizes->items.size() != shape.size()) throw "a tensor has a wrong shape";
        std::size_t bytes = width;
        for (std::size_t i = 0; i < shape.size(); i++) {
            const std::size_t size = whole(sizes->items[i].second);
            if (shape[i] != 0 && shape[i] != size) throw "a tensor has a wrong shape";
            if (size == 0 || bytes > bytes_.size() / size) throw "a tensor is larger than the file";
            shape[i] = size;
            bytes *= size;
        }
        const std::size_t begin = whole(offsets->items[0].second), end = whole(offsets->items[1].second);
        if (begin > end || end - begin != bytes || end > bytes_.size() - body_) throw "a tensor lies outside the file";
        return bytes_.data() + body_ + begin;
    }

    void read() {
        using cells_detail::Json;
        if (bytes_.size() < 8) throw "it is too short";
        const std::uint64_t length = cells_detail::long_word(bytes_.data());
        if (length > bytes_.size() - 8 || length > (std::uint64_t{1} << 26)) throw "its header is longer than the file";
        body_ = 8 + static_cast<std::size_t>(length);
        const std::string text_of_header(reinterpret_cast<const char *>(bytes_.data()) + 8,
                                         static_cast<std::size_t>(length));
        const Json header = cells_detail::JsonReader(text_of_header).whole();
        const Json *meta = header.find("__metadata__");
        if (meta == nullptr || text(*meta, "format") != "spiral-atlas") throw "it is no atlas of Spiral Atlas";
        if (text(*meta, "format_version") != "1") throw "its format has another version than 1";
        if (text(*meta, "kind") != "cells") throw "it holds nodes, not cells";
        family_ = text(*meta, "family");
        const Json flags = cells_detail::JsonReader(text(*meta, "flags")).whole();
        for (const auto &flag : flags.items) flags_.push_back(text(flag.second, "name"));
        if (flags_.empty() || flags_.size() > 8) throw "it has no flags, or more than 8";
        const Json axes = cells_detail::JsonReader(text(*meta, "axes")).whole();
        if (axes.items.empty() || axes.items.size() > most_axes) throw "it has no axes, or more than 5";
        std::size_t resolution = 0;
        for (const auto &axis : axes.items) {
            std::vector<std::size_t> shape{0};
            const unsigned char *values = tensor(header, text(axis.second, "name"), "F64", 8, shape);
            if (shape[0] == 1) {
                if (!std::isfinite(cells_detail::number(values))) throw "the value of an axis is no number";
                axes_.emplace_back(text(axis.second, "name"), cells_detail::number(values));
                continue;
            }
            if (divided_ > 0 && shape[0] != resolution + 1) throw "its axes have different numbers of edges";
            resolution = shape[0] - 1;
            divided_++;
            if (resolution < 2 || resolution > 2048 || (resolution & (resolution - 1)) != 0)
                throw "its resolution is no power of two from 2 to 2048";
            std::vector<double> edges;
            for (std::size_t i = 0; i <= resolution; i++) {
                edges.push_back(cells_detail::number(values + 8 * i));
                if (!std::isfinite(edges[i]) || (i > 0 && !(edges[i - 1] < edges[i])))
                    throw "the edges of an axis do not increase";
            }
            axes_.emplace_back(text(axis.second, "name"), std::move(edges), text(axis.second, "spacing") == "log");
        }
        if (divided_ == 0 || divided_ > most_divided) throw "it has no axes of several values, or more than 4";
        while ((std::size_t{1} << depth_) < resolution) depth_++;
        const unsigned most = 12 / static_cast<unsigned>(divided_);
        top_ = depth_ < most ? depth_ : most;
        // Each bit of an index within a top cell, with room for those of the other axes.
        for (std::uint64_t i = 0; i < std::uint64_t{1} << (depth_ - top_); i++) {
            std::uint64_t spread = 0;
            for (unsigned bit = 0; bit < depth_ - top_; bit++) spread |= (i >> bit & 1) << (bit * divided_);
            spread_.push_back(spread);
        }
        std::vector<std::size_t> shape(divided_ + 1, std::size_t{1} << top_);
        shape.back() = flags_.size();
        roots_ = tensor(header, "roots", "U32", 4, shape);
        shape.back() = 2;
        known_ = tensor(header, "top", "U8", 1, shape);
        std::vector<std::size_t> any{0};
        trees_ = tensor(header, "trees", "U32", 4, any);
        check(any[0]);
    }

    /// One pass: every place that a word names is the next free one.
    void check(std::size_t count) const {
        const unsigned all = (1u << flags_.size()) - 1, children = 1u << divided_;
        const std::uint32_t every = children == 16 ? 0xffffu : (1u << children) - 1;
        if (cells_detail::word(trees_) != 0) throw "its trees do not begin with the word 0";
        std::size_t next = 1;
        const std::size_t tops = std::size_t{1} << (top_ * divided_);
        for (std::size_t i = 0; i < tops; i++) {
            const unsigned yes = known_[2 * i], no = known_[2 * i + 1];
            if ((yes & no) != 0 || ((yes | no) & ~all) != 0)
                throw "a top cell says both yes and no, or names a flag that there is not";
            for (std::size_t flag = 0; flag < flags_.size(); flag++) {
                const std::size_t root = cells_detail::word(roots_ + 4 * (i * flags_.size() + flag));
                if (root == 0) continue;
                unsigned size = depth_ - top_;
                if (root != next || ((yes | no) >> flag & 1) != 0 || size == 0) throw "a root is not where it must be";
                std::size_t begin = next;
                next += words(size - 1);
                while (size-- > 0) {
                    const std::size_t end = next;
                    for (std::size_t at = begin; at < end; at += words(size)) {
                        if (at + words(size) > count) throw "its trees end too early";
                        const std::uint32_t node = cells_detail::word(trees_ + 4 * at);
                        const std::uint32_t in = node & 0xffff, out = node >> 16;
                        if ((in & out) != 0 || ((in | out) & ~every) != 0)
                            throw "a child is both, or there is no such child";
                        if (size == 0) continue;
                        const std::uint32_t to = cells_detail::word(trees_ + 4 * (at + 1));
                        const std::uint32_t open = every & ~(in | out);
                        if (to == 0) continue;
                        if (to != next || open == 0) throw "a node's children are not where they must be";
                        next += cells_detail::ones(open) * words(size - 1);
                    }
                    begin = end;
                }
            }
        }
        if (next != count) throw "its trees have words that nobody uses";
    }

    std::string path_, family_;
    cells_detail::Bytes bytes_;
    std::size_t body_ = 0, divided_ = 0;
    std::vector<std::string> flags_;
    std::vector<cells_detail::Axis> axes_;
    std::vector<std::uint64_t> spread_;
    unsigned depth_ = 0, top_ = 0;
    const unsigned char *roots_ = nullptr, *trees_ = nullptr, *known_ = nullptr;
};

} // namespace spiral_atlas

#endif
