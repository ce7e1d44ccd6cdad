#pragma once

#include <string>
#include <utility>
#include <vector>

#include <zlib.h>

namespace lamina::tests {

/// A ZIP archive (APPNOTE 6.3, sections 4.3 and 4.4) of these names and contents, deflated.
inline std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files) {
  const auto little = [](std::size_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 255U);
    return text;
  };
  std::string archive;
  std::string directory;
  for (const auto& [name, content] : files) {
    z_stream stream{};
    deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
    std::string packed(deflateBound(&stream, content.size()) + 16, '\0');
    std::string input = content;
    stream.next_in = reinterpret_cast<Bytef*>(input.data());
    stream.avail_in = static_cast<uInt>(input.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    const auto checksum =
        crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size()));
    const std::string facts = little(20, 2) + little(0, 2) + little(8, 2) + little(0, 4) +
                              little(checksum, 4) + little(packed.size(), 4) + little(content.size(), 4) +
                              little(name.size(), 2) + little(0, 2);
    directory += "PK\x01\x02" + little(20, 2) + facts + little(0, 2) + little(0, 2) + little(0, 2) +
                 little(0, 4) + little(archive.size(), 4) + name;
    archive += "PK\x03\x04" + facts + name + packed;
  }
  const std::size_t start = archive.size();
  archive += directory;
  archive += "PK\x05\x06" + little(0, 4) + little(files.size(), 2) + little(files.size(), 2) +
             little(directory.size(), 4) + little(start, 4) + little(0, 2);
  return archive;
}

}  // namespace lamina::tests
