#include <cassert>

#include <zlib.h>

#include "render/gzip_internal.h"

namespace rex::internal {

std::string gzip(std::string_view bytes) {
  constexpr int kLargestWindow = 15, kAsGzip = 16, kDefaultMemory = 8;
  z_stream stream{};
  [[maybe_unused]] int status = deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED,
                                             kLargestWindow + kAsGzip, kDefaultMemory, Z_DEFAULT_STRATEGY);
  assert(status == Z_OK);
  std::string packed(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  status = deflate(&stream, Z_FINISH);
  assert(status == Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

}  // namespace rex::internal
