// Reading of `--@` comments; see annotations.h. Tested by tests/unit/lang/annotation_test.cpp.
#include "frep/lang/annotations.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <string>

#include <fmt/format.h>

#include "frep/lang/lexer.h"

namespace frep::lang {
namespace {

constexpr std::array<std::string_view, 12> keys{"title",    "author", "license",        "source",
                                                "units",    "bounds", "param",          "color",
                                                "material", "view",   "set-operations", "hyperfun"};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\f'; }
bool is_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// What is left to read of one annotation line.
class Cursor {
  public:
    Cursor(const Source& source, Span span) : source_(source), position_(span.begin), end_(span.end) {
        while (end_ > position_ && is_blank(source_.text()[end_ - 1])) --end_;
        skip_blanks();
    }

    bool done() const { return position_ >= end_; }
    char peek() const { return done() ? '\0' : source_.text()[position_]; }
    std::string_view rest() const { return source_.text({position_, end_}); }
    /// The place of the next word, or of the end of the line when nothing is left.
    Span place() const {
        std::uint32_t stop = position_;
        while (stop < end_ && !is_blank(source_.text()[stop])) ++stop;
        return {position_, stop};
    }
    Span span_of_rest() const { return {position_, end_}; }
    void skip(std::size_t count) {
        position_ += static_cast<std::uint32_t>(std::min<std::size_t>(count, end_ - position_));
        skip_blanks();
    }
    bool accept(std::string_view mark) {
        if (!rest().starts_with(mark)) return false;
        skip(mark.size());
        return true;
    }
    /// A run of letters, digits and underscores; empty when there is none.
    std::string_view word() {
        std::size_t size = 0;
        while (size < rest().size() && is_word(rest()[size])) ++size;
        const std::string_view found = rest().substr(0, size);
        if (size > 0) skip(size);
        return found;
    }
    /// A finite number up to a blank, a comma, a bracket or `..`.
    bool number(double& value) {
        const std::string_view all = rest();
        const std::size_t size = std::min({all.find_first_of(" \t\f,]"), all.find(".."), all.size()});
        std::string_view digits = all.substr(0, size);
        if (digits.starts_with('+')) digits.remove_prefix(1);
        const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error != std::errc() || stop != digits.data() + digits.size() || !std::isfinite(value))
            return false;
        skip(size);
        return true;
    }

  private:
    void skip_blanks() {
        while (position_ < end_ && is_blank(source_.text()[position_])) ++position_;
    }

    const Source& source_;
    std::uint32_t position_;
    std::uint32_t end_;
};

class Reader {
  public:
    Reader(const Source& source, Program& program, Reporter& report)
        : source_(source), program_(program), out_(program.annotations), report_(report) {}

    // annotation = "--@" key value
    void read(Span line) {
        Cursor cursor(source_, {line.begin + 3, line.end});
        const Span key_place = cursor.place();
        const std::string key = lower_case(cursor.rest().substr(0, key_place.end - key_place.begin));
        if (std::find(keys.begin(), keys.end(), key) == keys.end()) return unknown_key(key, key_place);
        cursor.skip(key.size());
        if (cursor.done())
            return warn(
                Code::annotation_malformed, key_place,
                {fmt::format("the annotation `{}` has no value", key), "a value is missing behind it"});
        if (key == "param") return parameter(cursor);
        if (key != "hyperfun" && !seen_.insert(key).second)
            return warn(Code::annotation_repeated, key_place,
                        {fmt::format("the annotation `{}` is given twice", key), "this one does not count",
                         "remove one of the two lines"});
        if (key == "bounds") return bounds(cursor);
        if (key == "color") return color(cursor);
        if (key == "material") return material(cursor);
        if (key == "view") return view(cursor);
        if (key == "set-operations") return set_operations(cursor);
        if (key == "hyperfun") return dialect(cursor, line, key_place);
        text_of(key) = std::string(cursor.rest());
    }

  private:
    void warn(Code code, Span span, Words words) { report_.report(code, span, std::move(words)); }

    std::string& text_of(std::string_view key) {
        if (key == "title") return out_.title;
        if (key == "author") return out_.author;
        if (key == "license") return out_.license;
        if (key == "source") return out_.source;
        return out_.units;
    }

    void unknown_key(const std::string& key, Span place) {
        if (key.empty())
            return warn(Code::annotation_malformed, place,
                        {"this annotation has no key", "a key is expected",
                         "write for instance --@ title Name, or -- with a blank for a comment"});
        const std::string_view near = nearest_name(key, {keys.begin(), keys.end()});
        warn(Code::annotation_unknown_key, place,
             {fmt::format("there is no annotation {}", Reporter::quote(key)), "unknown key",
              near.empty() ? "known are title, author, license, source, units, bounds, param, color, "
                             "material, view, set-operations and hyperfun"
                           : fmt::format("did you mean `{}`?", near)});
    }

    /// Numbers up to the end of the line, separated by blanks or commas; false, with a report, for others.
    bool numbers(Cursor& cursor, std::vector<double>& values) {
        while (!cursor.done()) {
            double value = 0;
            const Span place = cursor.place();
            if (!cursor.number(value)) {
                warn(Code::annotation_malformed, place,
                     {fmt::format("{} is not a number", report_.quote(place)), "a number is expected"});
                return false;
            }
            values.push_back(value);
            cursor.accept(",");
        }
        return true;
    }

    const Object* shown_object() const {
        for (const Object& object : program_.objects)
            if (object.name == "my_model") return &object;
        return program_.objects.empty() ? nullptr : &program_.objects.front();
    }

    // bounds = min max { min max }
    void bounds(Cursor& cursor) {
        const Span place = cursor.span_of_rest();
        std::vector<double> values;
        if (!numbers(cursor, values)) return;
        const Object* object = shown_object();
        const std::size_t axes = values.size() / 2;
        if (values.size() % 2 != 0)
            return warn(Code::annotation_bounds, place,
                        {fmt::format("the bounds have {} numbers, which is odd", values.size()),
                         "pairs are expected", "give the least and the greatest value for every axis"});
        for (std::size_t i = 0; i < axes; ++i)
            if (values[2 * i] > values[2 * i + 1])
                return warn(Code::annotation_bounds, place,
                            {fmt::format("the bounds of axis {} end before they begin", i + 1),
                             {},
                             "give the least value first"});
        const std::size_t coordinates = object ? object->arrays[array_x].size : axes;
        if (object && (axes > coordinates || axes < std::min<std::size_t>(3, coordinates)))
            return warn(
                Code::annotation_bounds, place,
                {fmt::format("the bounds have {} pairs, the object has {} coordinates", axes, coordinates),
                 {},
                 "give one pair for every coordinate"});
        out_.bounds = std::move(values);
    }

    // color = red green blue
    void color(Cursor& cursor) {
        const Span place = cursor.span_of_rest();
        std::vector<double> values;
        if (!numbers(cursor, values)) return;
        const bool in_range =
            std::all_of(values.begin(), values.end(), [](double v) { return v >= 0 && v <= 1; });
        if (values.size() != 3 || !in_range)
            return warn(
                Code::annotation_malformed, place,
                {"a color is three numbers from 0 to 1", {}, "write red, green and blue: --@ color 1 0.5 0"});
        out_.color = std::move(values);
    }

    // material = word; which words mean something is the renderer's business
    void material(Cursor& cursor) {
        const Span place = cursor.span_of_rest();
        const std::string_view name = cursor.word();
        if (name.empty() || !cursor.done())
            return warn(Code::annotation_malformed, place,
                        {"a material is one word", {}, "write for instance --@ material lacquer"});
        out_.material = lower_case(name);
    }

    // view = azimuth elevation
    void view(Cursor& cursor) {
        const Span place = cursor.span_of_rest();
        std::vector<double> values;
        if (!numbers(cursor, values)) return;
        if (values.size() != 2 || values[1] < -90 || values[1] > 90)
            return warn(Code::annotation_malformed, place,
                        {"a view is two angles in degrees, the second from -90 to 90",
                         {},
                         "write azimuth and elevation: --@ view 30 20"});
        out_.view = std::move(values);
    }

    // set operations = "r0" | "min-max" | "r-alpha" number | "r0m" number | "rp" number
    void set_operations(Cursor& cursor) {
        using Kind = shapes::SetSystem::Kind;
        struct Row {
            std::string_view name;
            Kind kind;
            bool (*takes)(double);  ///< null: no number
        };
        constexpr std::array<Row, 5> systems{{
            {"r0", Kind::r0, nullptr},
            {"min-max", Kind::min_max, nullptr},
            {"r-alpha", Kind::r_alpha, [](double v) { return v > -1 && v <= 1; }},
            {"r0m", Kind::r0m, [](double v) { return v >= 0; }},
            {"rp", Kind::rp, [](double v) { return v > 1; }},
        }};
        const Span place = cursor.span_of_rest(), word = cursor.place();
        const std::string name = lower_case(source_.text(word));
        cursor.skip(name.size());
        for (const Row& row : systems) {
            if (row.name != name) continue;
            shapes::SetSystem system{row.kind, 0};
            if (row.takes && !(cursor.number(system.parameter) && row.takes(system.parameter))) break;
            if (!cursor.done()) break;
            out_.set_operations = system;
            if (row.kind != Kind::r0)
                warn(Code::set_operations_differ, place,
                     {"the operators | & \\ @ of this file are not those of old tools", "old tools use r0",
                      "the solid is the same; values, blends and offsets differ"});
            return;
        }
        warn(Code::annotation_malformed, place,
             {fmt::format("{} is no system of set operations", report_.quote(place)), "unknown system",
              "write r0, min-max, r-alpha 0.5 (above -1, up to 1), r0m 1 (from 0) or rp 4 (above 1)"});
    }

    // dialect = "2" | "3", in the file's first line
    void dialect(Cursor& cursor, Span line, Span key) {
        double value = 0;
        const Span place = cursor.place();
        const bool is_number = cursor.number(value) && cursor.done();
        if (!is_number || (value != 2 && value != 3))
            return warn(
                Code::annotation_malformed, place,
                {"the dialect of HyperFun is 2 or 3", "not a dialect", "leave the line out for dialect 2"});
        if (source_.locate(line.begin).line != 1)
            return warn(Code::dialect_not_first, key,
                        {"the dialect must be stated in the first line", "too late, not used",
                         "move this line to the top of the file"});
        out_.dialect = static_cast<int>(value);
        if (value == 3)
            warn(Code::dialect_unsupported, place,
                 {"dialect 3 is not supported yet", "read as dialect 2",
                  "remove the line, or use a later version"});
    }

    // parameter = "a" "[" number "]" name [ low ".." high ] [ "default" number ] [ '"' text '"' ]
    void parameter(Cursor& cursor) {
        ParameterAnnotation parameter;
        const Span whole = cursor.span_of_rest();
        const Span index_place = cursor.place();
        double index = 0;
        const bool is_a = cursor.peek() == 'a' || cursor.peek() == 'A';
        if (!is_a) return malformed(index_place, "a parameter, a[1], is expected");
        cursor.skip(1);
        if (!cursor.accept("[") || !cursor.number(index) || index != std::floor(index) || index < 1 ||
            index > 1e6 || !cursor.accept("]"))
            return malformed(index_place, "a parameter, a[1], is expected");
        parameter.index = static_cast<int>(index);
        parameter.span = whole;
        const Span name_place = cursor.place();
        parameter.name = std::string(cursor.word());
        const char first = parameter.name.empty() ? '0' : parameter.name.front();
        if (first == '_' || (first >= '0' && first <= '9'))
            return malformed(name_place, "a name is expected: a letter, then letters, digits, `_`");
        if (!range(cursor, parameter) || !default_value(cursor, parameter) || !description(cursor, parameter))
            return;
        check(parameter, index_place, name_place);
    }

    void malformed(Span place, std::string_view expected) {
        warn(Code::annotation_param, place,
             {"this parameter annotation cannot be read", std::string(expected),
              "write for instance --@ param a[1] height 40..90 default 64 \"Height\""});
    }

    bool range(Cursor& cursor, ParameterAnnotation& parameter) {
        const char c = cursor.peek();
        const bool number_follows = (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
        if (!number_follows) return true;
        const Span place = cursor.place();
        if (!cursor.number(parameter.low) || !cursor.accept("..") || !cursor.number(parameter.high)) {
            malformed(place, "a range, 40..90, is expected");
            return false;
        }
        if (parameter.low > parameter.high) {
            warn(Code::annotation_param, place,
                 {"this range ends before it begins", {}, "give the least value first: 40..90"});
            return false;
        }
        parameter.has_range = true;
        return true;
    }

    bool default_value(Cursor& cursor, ParameterAnnotation& parameter) {
        const Span word = cursor.place();
        if (lower_case(source_.text(word)) != "default") return true;
        cursor.skip(word.end - word.begin);
        const Span place = cursor.place();
        if (!cursor.number(parameter.value)) {
            malformed(place, "a number is expected after `default`");
            return false;
        }
        if (parameter.has_range && (parameter.value < parameter.low || parameter.value > parameter.high)) {
            warn(Code::annotation_param, place,
                 {"this default is not in the range", {}, "widen the range, or choose another default"});
            return false;
        }
        parameter.has_default = true;
        return true;
    }

    bool description(Cursor& cursor, ParameterAnnotation& parameter) {
        if (cursor.done()) return true;
        const std::string_view text = cursor.rest();
        if (text.size() < 2 || text.front() != '"' || text.find('"', 1) != text.size() - 1) {
            malformed(cursor.span_of_rest(), "a text in quotation marks, or nothing, is expected");
            return false;
        }
        parameter.description = std::string(text.substr(1, text.size() - 2));
        return true;
    }

    void check(ParameterAnnotation& parameter, Span index_place, Span name_place) {
        const Object* object = shown_object();
        if (object && static_cast<std::uint32_t>(parameter.index) > object->arrays[array_a].size)
            return warn(Code::annotation_param_index, index_place,
                        {fmt::format("{} has no parameter a[{}]", Reporter::quote(object->written_name),
                                     parameter.index),
                         fmt::format("its header has a[{}]", object->arrays[array_a].size),
                         "raise the size in the header, or remove this line"});
        const bool new_index = indexes_.insert(parameter.index).second;
        const bool new_name = names_.insert(lower_case(parameter.name)).second;
        if (!new_index || !new_name)
            return warn(Code::annotation_repeated, new_index ? name_place : index_place,
                        {fmt::format("this parameter's {} is given twice", new_index ? "name" : "number"),
                         "this line does not count", "remove one of the two lines"});
        out_.parameters.push_back(std::move(parameter));
    }

    const Source& source_;
    Program& program_;
    Annotations& out_;
    Reporter& report_;
    std::set<std::string, std::less<>> seen_;
    std::set<int> indexes_;
    std::set<std::string> names_;
};

}  // namespace

void read_annotations(const Source& source, const std::vector<Span>& places, Program& program,
                      Reporter& report) {
    Reader reader(source, program, report);
    for (Span place : places) {
        if (report.stopped()) return;
        reader.read(place);
    }
}

}  // namespace frep::lang
