// Implementation of rename.h.
#include "frep/lang/rename.h"

#include <algorithm>
#include <set>

#include "frep/lang/lexer.h"

namespace frep::lang {

std::string with_renamed_objects(const Source& source, const Program& program, std::string_view prefix) {
    std::set<std::string, std::less<>> names;
    for (const Object& object : program.objects) names.insert(object.name);
    struct Edit {
        std::uint32_t at;
        bool is_name;  ///< else the @ of an annotation, which goes
    };
    std::vector<Edit> edits;
    Lexer lexer(source);
    for (Token token = lexer.next(); token.kind != TokenKind::end; token = lexer.next())
        if (token.kind == TokenKind::identifier && names.contains(lower_case(source.text(token.span))))
            edits.push_back({token.span.begin, true});
    for (const Span& place : lexer.annotations()) edits.push_back({place.begin + 2, false});
    std::sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.at < b.at; });
    std::string out;
    std::uint32_t done = 0;
    for (const Edit& edit : edits) {
        out += source.text({done, edit.at});
        if (edit.is_name) out += prefix;
        done = edit.at + (edit.is_name ? 0 : 1);
    }
    out += source.text({done, static_cast<std::uint32_t>(source.text().size())});
    return out;
}

}  // namespace frep::lang
