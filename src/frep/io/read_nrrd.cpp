// NRRD, "nearly raw raster data" (G. Kindlmann, Teem, https://teem.sourceforge.net/nrrd/format.html): a text
// header, then numbers as bytes, gzip or text, in the file or in one that the header names. Read are volumes
// of three axes (further ones of one sample are dropped), all scalar types, both byte orders; spacings, or
// space directions and origin. Tested by tests/unit/io/read_nrrd_test.cpp.
#include <array>
#include <bit>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <zlib.h>

#include "frep/io/read_formats.h"
#include "frep/io/read_volume_formats.h"

namespace frep::reading {

namespace {

enum class Number { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

struct NumberName {
    std::string_view name;
    Number number;
};
constexpr NumberName number_names[] = {
    {"signed char", Number::int8},
    {"int8", Number::int8},
    {"int8_t", Number::int8},
    {"uchar", Number::uint8},
    {"unsigned char", Number::uint8},
    {"uint8", Number::uint8},
    {"uint8_t", Number::uint8},
    {"short", Number::int16},
    {"short int", Number::int16},
    {"signed short", Number::int16},
    {"signed short int", Number::int16},
    {"int16", Number::int16},
    {"int16_t", Number::int16},
    {"ushort", Number::uint16},
    {"unsigned short", Number::uint16},
    {"unsigned short int", Number::uint16},
    {"uint16", Number::uint16},
    {"uint16_t", Number::uint16},
    {"int", Number::int32},
    {"signed int", Number::int32},
    {"int32", Number::int32},
    {"int32_t", Number::int32},
    {"uint", Number::uint32},
    {"unsigned int", Number::uint32},
    {"uint32", Number::uint32},
    {"uint32_t", Number::uint32},
    {"longlong", Number::int64},
    {"long long", Number::int64},
    {"long long int", Number::int64},
    {"int64", Number::int64},
    {"int64_t", Number::int64},
    {"ulonglong", Number::uint64},
    {"unsigned long long", Number::uint64},
    {"uint64", Number::uint64},
    {"uint64_t", Number::uint64},
    {"float", Number::float32},
    {"double", Number::float64},
};

std::size_t bytes_of(Number number) {
    switch (number) {
        case Number::int8:
        case Number::uint8:
            return 1;
        case Number::int16:
        case Number::uint16:
            return 2;
        case Number::int32:
        case Number::uint32:
        case Number::float32:
            return 4;
        case Number::int64:
        case Number::uint64:
        case Number::float64:
            return 8;
    }
    return 8;
}

double number_at(const char* data, Number number, bool big) {
    switch (number) {
        case Number::int8:
            return static_cast<std::int8_t>(load<std::uint8_t>(data, big));
        case Number::uint8:
            return load<std::uint8_t>(data, big);
        case Number::int16:
            return static_cast<std::int16_t>(load<std::uint16_t>(data, big));
        case Number::uint16:
            return load<std::uint16_t>(data, big);
        case Number::int32:
            return static_cast<std::int32_t>(load<std::uint32_t>(data, big));
        case Number::uint32:
            return load<std::uint32_t>(data, big);
        case Number::int64:
            return static_cast<double>(static_cast<std::int64_t>(load<std::uint64_t>(data, big)));
        case Number::uint64:
            return static_cast<double>(load<std::uint64_t>(data, big));
        case Number::float32:
            return static_cast<double>(load_float(data, big));
        case Number::float64:
            return std::bit_cast<double>(load<std::uint64_t>(data, big));
    }
    return 0;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r'))
        text.remove_suffix(1);
    return text;
}

std::string lowered(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return out;
}

struct Field {
    std::string_view text;
    std::size_t line;
};

class NrrdReader {
  public:
    NrrdReader(std::string_view bytes, const ReadBeside& read_beside)
        : bytes_(bytes), read_beside_(read_beside) {}

    Result<VolumeFile> read() {
        if (const Status status = read_header(); !status) return status.error();
        if (const Status status = read_layout(); !status) return status.error();
        if (const Status status = read_place(); !status) return status.error();
        std::string beside;
        auto data = find_data(beside);
        if (!data) return data.error();
        if (const Status status = read_values(*data); !status) return status.error();
        return std::move(out_);
    }

  private:
    Status read_header() {
        std::size_t line = 1, at = std::min(bytes_.find('\n'), bytes_.size() - 1) + 1;
        while (at < bytes_.size()) {
            ++line;
            const std::size_t end = std::min(bytes_.find('\n', at), bytes_.size());
            const std::string_view text = trimmed(bytes_.substr(at, end - at));
            at = std::min(end + 1, bytes_.size());
            if (text.empty()) {
                data_ = bytes_.substr(at);
                has_data_ = true;
                break;
            }
            if (text[0] == '#') continue;
            const std::size_t colon = text.find(':');
            if (colon == std::string_view::npos || colon + 1 >= text.size())
                return malformed_line(line, fmt::format("expected `field: value`, found {}", quoted(text)));
            if (text[colon + 1] == '=') continue;  // a key of somebody's own
            const std::string name = lowered(trimmed(text.substr(0, colon)));
            fields_[name == "datafile" ? "data file" : name] = {trimmed(text.substr(colon + 1)), line};
        }
        return {};
    }

    const Field* find(const std::string& name) const {
        const auto found = fields_.find(name);
        return found == fields_.end() ? nullptr : &found->second;
    }

    Result<Field> need(const std::string& name) const {
        const Field* field = find(name);
        if (!field) return Error{ErrorKind::io, fmt::format("the header has no `{}`", name)};
        return *field;
    }

    static std::vector<std::string_view> words(std::string_view text) {
        std::vector<std::string_view> out;
        std::string_view word;
        for (Words words(text); words.next(word);) out.push_back(word);
        return out;
    }

    Status read_layout() {
        const auto type = need("type"), dimension = need("dimension"), sizes = need("sizes"),
                   encoding = need("encoding");
        for (const auto* field : {&type, &dimension, &sizes, &encoding})
            if (!*field) return field->error();
        const std::string name = lowered(type->text);
        bool known = false;
        for (const NumberName& row : number_names) {
            if (row.name != name) continue;
            number_ = row.number;
            known = true;
        }
        if (!known)
            return malformed_line(type->line, fmt::format("no type {} of numbers", quoted(type->text)));
        const auto count = parse_integer(dimension->text);
        if (!count || *count < 3 || *count > 16)
            return malformed_line(dimension->line,
                                  fmt::format("expected 3 axes, found {}", quoted(dimension->text)));
        const auto numbers = words(sizes->text);
        if (numbers.size() != static_cast<std::size_t>(*count))
            return malformed_line(sizes->line,
                                  fmt::format("expected {} sizes, found {}", *count, numbers.size()));
        std::vector<std::size_t> used;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const auto size = parse_integer(numbers[i]);
            if (!size || *size < 1)
                return malformed_line(sizes->line,
                                      fmt::format("expected a size, found {}", quoted(numbers[i])));
            if (*size == 1 && numbers.size() - i + used.size() > 3) continue;
            used.push_back(static_cast<std::size_t>(*size));
            axis_.push_back(i);
        }
        axes_ = numbers.size();
        if (used.size() != 3) return malformed_line(sizes->line, "more than 3 axes have samples");
        out_.volume.size = {used[0], used[1], used[2]};
        if (const auto error = size_error(out_.volume.size)) {
            Error placed = malformed_line(sizes->line, error->message);
            placed.kind = error->kind;
            return placed;
        }
        samples_ = used[0] * used[1] * used[2];
        encoding_ = lowered(encoding->text);
        if (encoding_ == "gz") encoding_ = "gzip";
        if (encoding_ == "txt" || encoding_ == "text") encoding_ = "ascii";
        if (encoding_ != "raw" && encoding_ != "gzip" && encoding_ != "ascii")
            return malformed_line(
                encoding->line,
                fmt::format("encoding {} is not read: raw, gzip and ascii are", quoted(encoding->text)));
        if (bytes_of(number_) == 1 || encoding_ == "ascii") return {};
        const auto endian = need("endian");
        if (!endian) return endian.error();
        const std::string order = lowered(endian->text);
        if (order != "little" && order != "big")
            return malformed_line(endian->line,
                                  fmt::format("expected `little` or `big`, found {}", quoted(endian->text)));
        big_ = order == "big";
        return {};
    }

    /// A vector "(x,y,z)".
    static std::optional<Vec3> vector(std::string_view text) {
        if (text.size() < 2 || text.front() != '(' || text.back() != ')') return std::nullopt;
        std::string inner(text.substr(1, text.size() - 2));
        for (char& c : inner)
            if (c == ',') c = ' ';
        double v[3];
        const auto numbers = words(inner);
        if (numbers.size() != 3) return std::nullopt;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto number = parse_number<double>(numbers[i]);
            if (!number) return std::nullopt;
            v[i] = *number;
        }
        return Vec3{v[0], v[1], v[2]};
    }

    /// The words of a list of vectors: blanks inside parentheses do not divide.
    static std::vector<std::string> vector_words(std::string_view text) {
        std::string joined;
        int depth = 0;
        for (const char c : text) {
            if (c == '(') ++depth;
            if (c == ')') --depth;
            if ((c == ' ' || c == '\t') && depth > 0) continue;
            joined += c;
        }
        std::vector<std::string> out;
        for (const std::string_view word : words(joined)) out.emplace_back(word);
        return out;
    }

    Status read_place() {
        Volume& volume = out_.volume;
        if (const Field* field = find("space directions")) {
            const auto list = vector_words(field->text);
            if (list.size() != axes_)
                return malformed_line(field->line, fmt::format("expected {} directions", axes_));
            for (std::size_t i = 0; i < 3; ++i) {
                const auto direction = vector(list[axis_[i]]);
                if (!direction)
                    return malformed_line(
                        field->line,
                        fmt::format("expected a direction as (x,y,z), found {}", quoted(list[axis_[i]])));
                volume.axes[i] = *direction;
            }
        } else if (const Field* spacings = find("spacings")) {
            const auto list = words(spacings->text);
            if (list.size() != axes_)
                return malformed_line(spacings->line, fmt::format("expected {} spacings", axes_));
            for (std::size_t i = 0; i < 3; ++i) {
                const auto spacing = parse_number<double>(list[axis_[i]]);
                if (!spacing)
                    return malformed_line(spacings->line,
                                          fmt::format("expected a number, found {}", quoted(list[axis_[i]])));
                if (*spacing == *spacing) volume.axes[i] = volume.axes[i] * *spacing;  // nan: not known
            }
        } else if (find("axis mins") || find("axis maxs")) {
            out_.notes.emplace_back(
                "`axis mins` and `axis maxs` are not read, spacings are: samples stand 1 apart");
        }
        if (const Field* field = find("space origin")) {
            const auto list = vector_words(field->text);
            const auto origin = list.size() == 1 ? vector(list[0]) : std::nullopt;
            if (!origin)
                return malformed_line(
                    field->line, fmt::format("expected an origin as (x,y,z), found {}", quoted(field->text)));
            volume.origin = *origin;
        }
        if (!is_placed(volume)) return Error{ErrorKind::io, "the axes of the grid do not span space"};
        return {};
    }

    /// What follows the header, or the content of the file that it names, without what is to be skipped.
    Result<std::string_view> find_data(std::string& beside) {
        std::string_view data = data_;
        if (const Field* field = find("data file")) {
            const std::string name(field->text);
            if (name == "LIST" || name.starts_with("LIST ") || name.find('%') != std::string::npos)
                return malformed_line(field->line, "volumes in several data files are not read");
            if (!read_beside_) return malformed_line(field->line, "there is no file access here");
            auto content = read_beside_(name);
            if (!content) return content.error();
            beside = std::move(*content);
            data = beside;
        } else if (!has_data_) {
            return Error{ErrorKind::io, "the header has no end (an empty line) and names no data file"};
        }
        std::int64_t skips[2] = {0, 0};
        const char* names[2] = {"line skip", "byte skip"};
        for (int i = 0; i < 2; ++i) {
            const Field* field = find(names[i]);
            if (!field) continue;
            const auto count = parse_integer(field->text);
            if (!count || *count < (i == 1 && encoding_ == "raw" ? -1 : 0))
                return malformed_line(field->line,
                                      fmt::format("expected a count, found {}", quoted(field->text)));
            skips[i] = *count;
        }
        for (; skips[0] > 0 && !data.empty(); --skips[0])
            data.remove_prefix(std::min(data.find('\n'), data.size() - 1) + 1);
        if (skips[1] < 0) {  // the samples are the end of the file
            const std::size_t needed = samples_ * bytes_of(number_);
            if (data.size() > needed) data.remove_prefix(data.size() - needed);
        } else if (encoding_ != "gzip") {
            data.remove_prefix(std::min(static_cast<std::size_t>(skips[1]), data.size()));
        } else {
            skip_unpacked_ = static_cast<std::size_t>(skips[1]);
        }
        return data;
    }

    Error too_short(std::size_t found, std::string_view what) const {
        return {ErrorKind::io, fmt::format("the data have {} of {} {}", found, samples_, what)};
    }

    Status read_values(std::string_view data) {
        std::vector<double>& values = out_.volume.values;
        if (encoding_ == "ascii") {
            if (data.size() / 2 + 1 < samples_) return too_short(data.size() / 2 + 1, "numbers at most");
            values.reserve(samples_);
            std::string_view word;
            for (Words words(data); values.size() < samples_ && words.next(word);) {
                const auto number = parse_number<double>(word);
                if (!number)
                    return Error{ErrorKind::io, fmt::format("expected a number, found {}", quoted(word))};
                values.push_back(*number);
            }
            if (values.size() < samples_) return too_short(values.size(), "numbers");
        } else if (encoding_ == "gzip") {
            if (const Status status = unpack(data); !status) return status;
        } else {
            if (data.size() / bytes_of(number_) < samples_)
                return too_short(data.size() / bytes_of(number_), "samples");
            values.reserve(samples_);
            append(data.substr(0, samples_ * bytes_of(number_)));
        }
        for (const double value : values)
            if (!is_finite(value)) return Error{ErrorKind::io, "a sample is not finite"};
        return {};
    }

    void append(std::string_view data) {
        const std::size_t bytes = bytes_of(number_);
        for (std::size_t at = 0; at + bytes <= data.size(); at += bytes)
            out_.volume.values.push_back(number_at(data.data() + at, number_, big_));
    }

    /// Inflates piece by piece and stops when there are samples enough, so that memory follows what is there.
    Status unpack(std::string_view data) {
        z_stream stream{};
        if (inflateInit2(&stream, 15 + 32) != Z_OK) return Error{ErrorKind::io, "zlib does not start"};
        struct End {
            z_stream* stream;
            ~End() { inflateEnd(stream); }
        } const end{&stream};
        constexpr std::size_t piece = std::size_t{8} << 16;
        std::string out;
        std::size_t kept = 0;  // of a sample that a piece cuts
        int state = Z_OK;
        while (out_.volume.values.size() < samples_ && state == Z_OK) {
            if (stream.avail_in == 0 && !data.empty()) {
                const std::size_t next = std::min(data.size(), std::size_t{1} << 30);
                stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
                stream.avail_in = static_cast<uInt>(next);
                data.remove_prefix(next);
            }
            out.resize(kept + piece);
            stream.next_out = reinterpret_cast<Bytef*>(out.data() + kept);
            stream.avail_out = static_cast<uInt>(piece);
            state = inflate(&stream, Z_NO_FLUSH);
            std::size_t size = kept + piece - stream.avail_out;
            if (size == kept && state == Z_OK) break;
            out.resize(size);
            const std::size_t skipped = std::min(skip_unpacked_, size);
            out.erase(0, skipped);
            skip_unpacked_ -= skipped;
            const std::size_t bytes = bytes_of(number_);
            const std::size_t whole =
                std::min(out.size() / bytes, samples_ - out_.volume.values.size()) * bytes;
            append(std::string_view(out).substr(0, whole));
            out.erase(0, whole);
            kept = out.size();
        }
        if (out_.volume.values.size() == samples_) return {};
        if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR)
            return Error{ErrorKind::io, "the gzip data are damaged"};
        return too_short(out_.volume.values.size(), "samples");
    }

    std::string_view bytes_, data_;
    const ReadBeside& read_beside_;
    std::map<std::string, Field> fields_;
    bool has_data_ = false, big_ = false;
    Number number_ = Number::uint8;
    std::string encoding_;
    std::vector<std::size_t> axis_;  ///< the axes that have samples
    std::size_t axes_ = 0, samples_ = 0, skip_unpacked_ = 0;
    VolumeFile out_;
};

}  // namespace

bool is_nrrd(std::string_view bytes) {
    return bytes.size() >= 8 && bytes.starts_with("NRRD000") && bytes[7] >= '1' && bytes[7] <= '9';
}

Result<VolumeFile> read_nrrd(std::string_view bytes, const ReadBeside& read_beside) {
    return NrrdReader(bytes, read_beside).read();
}

}  // namespace frep::reading
