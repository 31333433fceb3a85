// Implementation of zip.h.
#include "frep/io/zip.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <set>

#include "frep/io/encode.h"

namespace frep {

namespace {

using encode::append_little_endian;

constexpr std::uint64_t size_limit = 0xffffffffu;
constexpr std::size_t piece = std::size_t{1} << 20;  // bytes given to zlib at a time
constexpr int level = 6;

Error too_large(const std::string& what) {
    return {ErrorKind::over_limit, fmt::format("{} is larger than the 4 GiB that a zip file can hold", what)};
}

std::uint32_t crc_of(const std::string& bytes) {
    uLong crc = crc32(0, nullptr, 0);
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
        const std::size_t count = std::min(piece, bytes.size() - at);
        crc = crc32(crc, reinterpret_cast<const Bytef*>(bytes.data() + at), static_cast<uInt>(count));
    }
    return static_cast<std::uint32_t>(crc);
}

/// Appends `bytes` as a raw deflate stream.
Status append_deflated(std::string& out, const std::string& bytes) {
    z_stream stream{};
    if (deflateInit2(&stream, level, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
        return Error{ErrorKind::over_limit, "there is no memory left to compress"};
    }
    std::string buffer(piece, '\0');
    int state = Z_OK;
    for (std::size_t at = 0; state != Z_STREAM_END;) {
        const std::size_t count = std::min(piece, bytes.size() - at);
        // zlib reads through this pointer only; its type is not const for old compilers.
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + at));
        stream.avail_in = static_cast<uInt>(count);
        at += count;
        do {
            stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
            stream.avail_out = static_cast<uInt>(piece);
            state = deflate(&stream, at == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
            out.append(buffer, 0, piece - stream.avail_out);
        } while (stream.avail_out == 0);
    }
    deflateEnd(&stream);
    return {};
}

/// What the local header and the central directory both say of an entry.
struct Record {
    std::uint32_t crc = 0, packed = 0, size = 0, at = 0;
    bool deflated = false;
};

void append_common(std::string& out, const Record& record, const std::string& name) {
    append_little_endian(out, 20, 2);                       // version needed: 2.0, deflate
    append_little_endian(out, 0x0800, 2);                   // names are UTF-8
    append_little_endian(out, record.deflated ? 8 : 0, 2);  // method
    append_little_endian(out, 0, 2);                        // 0:00
    append_little_endian(out, 0x0021, 2);                   // 1980-01-01
    append_little_endian(out, record.crc);
    append_little_endian(out, record.packed);
    append_little_endian(out, record.size);
    append_little_endian(out, static_cast<std::uint32_t>(name.size()), 2);
    append_little_endian(out, 0, 2);  // no extra field
}

Status append_entry(std::string& out, const ZipEntry& entry, Record& record) {
    if (entry.bytes.size() > size_limit || out.size() > size_limit) return too_large(entry.name);
    record.at = static_cast<std::uint32_t>(out.size());
    record.crc = crc_of(entry.bytes);
    record.size = static_cast<std::uint32_t>(entry.bytes.size());
    std::string packed;
    if (Status ok = append_deflated(packed, entry.bytes); !ok) return ok;
    record.deflated = packed.size() < entry.bytes.size();
    const std::string& kept = record.deflated ? packed : entry.bytes;
    record.packed = static_cast<std::uint32_t>(kept.size());
    out += "PK\3\4";
    append_common(out, record, entry.name);
    out += entry.name;
    out += kept;
    return {};
}

void append_directory_entry(std::string& out, const Record& record, const std::string& name) {
    out += "PK\1\2";
    append_little_endian(out, 20, 2);  // made by: version 2.0, DOS attributes
    append_common(out, record, name);
    append_little_endian(out, 0, 2);  // no comment
    append_little_endian(out, 0, 2);  // disk
    append_little_endian(out, 0, 2);  // internal attributes
    append_little_endian(out, 0);     // external attributes
    append_little_endian(out, record.at);
    out += name;
}

Status check_names(const std::vector<ZipEntry>& entries) {
    if (entries.size() > 65534) return Error{ErrorKind::over_limit, "a zip file cannot hold so many entries"};
    std::set<std::string> names;
    for (const ZipEntry& entry : entries) {
        if (!entry.name.empty() && entry.name.size() <= 65535 && names.insert(entry.name).second) continue;
        return Error{ErrorKind::invalid_argument,
                     "the name of an entry of a zip file is empty, too long or used twice"};
    }
    return {};
}

}  // namespace

Result<std::string> zip(const std::vector<ZipEntry>& entries) {
    if (Status ok = check_names(entries); !ok) return ok.error();
    std::string out;
    std::vector<Record> records(entries.size());
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (Status ok = append_entry(out, entries[i], records[i]); !ok) return ok.error();
    }
    const std::uint64_t directory = out.size();
    for (std::size_t i = 0; i < entries.size(); ++i) {
        append_directory_entry(out, records[i], entries[i].name);
    }
    if (out.size() > size_limit) return too_large("the archive");
    out += "PK\5\6";
    append_little_endian(out, 0);  // disks
    append_little_endian(out, static_cast<std::uint32_t>(entries.size()), 2);
    append_little_endian(out, static_cast<std::uint32_t>(entries.size()), 2);
    append_little_endian(out, static_cast<std::uint32_t>(out.size() - 12 - directory));
    append_little_endian(out, static_cast<std::uint32_t>(directory));
    append_little_endian(out, 0, 2);  // no comment
    return out;
}

}  // namespace frep
