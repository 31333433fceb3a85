// Implementation of text.h.
#include "frep/io/text.h"

#include "frep/base/source.h"

namespace frep::encode {

namespace {

unsigned char byte(char c) { return static_cast<unsigned char>(c); }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The length of a UTF-8 sequence by its first byte.
std::size_t sequence_length(char c) {
    return byte(c) < 0x80 ? 1 : byte(c) < 0xe0 ? 2 : byte(c) < 0xf0 ? 3 : 4;
}

bool is_forbidden(std::string_view sequence) {
    if (sequence.size() == 1) return byte(sequence[0]) < 0x20 || sequence[0] == 0x7f;
    if (sequence.size() == 2) return byte(sequence[0]) == 0xc2 && byte(sequence[1]) < 0xa0;
    return sequence == "\xef\xbf\xbe" || sequence == "\xef\xbf\xbf";
}

}  // namespace

std::string clean_text(std::string_view text) {
    const std::string valid = to_valid_utf8(text);
    std::string clean;
    for (std::size_t i = 0; i < valid.size();) {
        const std::string_view sequence = std::string_view(valid).substr(i, sequence_length(valid[i]));
        i += sequence.size();
        if (sequence == "\t" || sequence == "\n" || sequence == "\r") {
            clean.push_back(' ');
        } else if (!is_forbidden(sequence)) {
            clean += sequence;
        }
    }
    return clean;
}

void append_xml(std::string& out, std::string_view text) {
    for (const char c : clean_text(text)) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&apos;";
                break;
            default:
                out.push_back(c);
        }
    }
}

void append_quoted(std::string& out, std::string_view text) {
    out.push_back('"');
    for (const char c : clean_text(text)) {
        if (c == '"' || c == '\\') out.push_back('\\');
        out.push_back(c);
    }
    out.push_back('"');
}

std::string identifier(std::string_view text, std::string_view prefix) {
    constexpr std::size_t longest = 60;
    const std::string clean = clean_text(text);
    std::string name;
    for (std::size_t i = 0; i < clean.size() && name.size() < longest; i += sequence_length(clean[i])) {
        if (is_letter(clean[i]) || is_digit(clean[i])) {
            name.push_back(clean[i]);
        } else if (name.empty() || name.back() != '_') {
            name.push_back('_');
        }
    }
    return name.empty() || !is_letter(name[0]) ? std::string(prefix) + name : name;
}

std::string word(std::string_view text, std::string_view when_empty) {
    std::string name = clean_text(text);
    for (char& c : name) {
        if (c == ' ' || c == '#') c = '_';
    }
    return name.empty() ? std::string(when_empty) : name;
}

std::string UniqueNames::unique(const std::string& name) {
    std::string candidate = name;
    for (std::size_t n = 2; !taken_.insert(candidate).second; ++n) {
        candidate = name + "_" + std::to_string(n);
    }
    return candidate;
}

}  // namespace frep::encode
