#include "engine/import/gzip.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>
#include <zlib.h>

#include "engine/import/import_error.h"

namespace lamina::engine {
namespace {

class Inflater {
 public:
  explicit Inflater(const std::string& file) {
    constexpr int kGzipOnly = 16;
    if (inflateInit2(&stream_, MAX_WBITS + kGzipOnly) != Z_OK)
      throw ImportError({.file = file}, "zlib does not start");
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&stream_); }

  z_stream& stream() { return stream_; }

 private:
  z_stream stream_{};
};

}  // namespace

bool is_gzip(std::string_view bytes) {
  return bytes.substr(0, 2) == "\x1f\x8b";
}

std::string inflate_gzip(std::string_view bytes, const std::string& file, std::size_t max_bytes) {
  Inflater inflater(file);
  z_stream& stream = inflater.stream();
  std::string content;
  std::array<char, 1 << 16> block{};
  std::size_t taken = 0;
  while (taken < bytes.size()) {
    const std::size_t offered = std::min<std::size_t>(bytes.size() - taken, std::numeric_limits<uInt>::max());
    // zlib reads only; its interface is older than const.
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + taken));
    stream.avail_in = static_cast<uInt>(offered);
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = static_cast<uInt>(block.size());
    const int status = inflate(&stream, Z_NO_FLUSH);
    taken += offered - stream.avail_in;
    const std::size_t made = block.size() - stream.avail_out;
    if (content.size() + made > max_bytes) {
      throw ImportError({.file = file}, fmt::format("inflates to more than {} bytes", max_bytes),
                        "decompress it first if it is meant to be that large");
    }
    content.append(block.data(), made);
    if (status == Z_STREAM_END) {
      // Another member may follow; anything else after the end is padding.
      if (!is_gzip(bytes.substr(taken))) return content;
      inflateReset(&stream);
    } else if (status != Z_OK) {
      throw ImportError({.file = file}, "the gzip data is damaged", "compress the file again");
    }
  }
  throw ImportError({.file = file}, "the gzip data is cut short", "copy the file again");
}

}  // namespace lamina::engine
