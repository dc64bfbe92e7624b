#include <array>
#include <cstdio>
#include <memory>

#include <fmt/format.h>
#include <jpeglib.h>
#include <png.h>

#include "base/error.h"
#include "formats/texture_reader_internal.h"

namespace rex::mesh {
namespace {

// Allocates the picture of a header that has been read.
Texture emptyTexture(std::size_t width, std::size_t height, const std::string& what) {
  if (width == 0 || height == 0 || width > kLongestTextureSide || height > kLongestTextureSide ||
      width * height > kMostTexturePixels)
    throw Error({.what = what,
                 .found = fmt::format("{} x {} pixels", width, height),
                 .wanted = fmt::format("at most {} per side and {} in total", kLongestTextureSide,
                                       kMostTexturePixels)});
  return {static_cast<int>(width), static_cast<int>(height), std::vector<std::uint8_t>(3 * width * height)};
}

Texture readPngTexture(std::string_view bytes, const std::string& what) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, void (*)(png_image*)> freed(&header, png_image_free);
  const auto fail = [&] {
    return Error({.what = what, .found = fmt::format("a faulty PNG file: {}", header.message)});
  };
  if (png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) == 0) throw fail();
  header.format = PNG_FORMAT_RGB;
  Texture texture = emptyTexture(header.width, header.height, what);
  const png_color white{255, 255, 255};
  const png_int_32 upward = -3 * texture.width;
  if (png_image_finish_read(&header, &white, texture.rgb.data(), upward, nullptr) == 0) throw fail();
  return texture;
}

// libjpeg reports through a function that must not return. The exception leaves C code that holds nothing but
// what jpeg_destroy_decompress frees.
struct JpegReader {
  explicit JpegReader(const std::string& start) : what(start) {
    info.err = jpeg_std_error(&errors);
    info.client_data = this;
    errors.error_exit = [](j_common_ptr broken) { fail(broken); };
    errors.emit_message = [](j_common_ptr broken, int level) {
      if (level < 0) fail(broken);  // a picture that is not whole
    };
    jpeg_create_decompress(&info);
  }
  ~JpegReader() { jpeg_destroy_decompress(&info); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  [[noreturn]] static void fail(j_common_ptr broken) {
    std::array<char, JMSG_LENGTH_MAX> message{};
    broken->err->format_message(broken, message.data());
    throw Error({.what = static_cast<JpegReader*>(broken->client_data)->what,
                 .found = fmt::format("a faulty JPEG file: {}", message.data())});
  }

  const std::string& what;
  jpeg_error_mgr errors{};
  jpeg_decompress_struct info{};
};

Texture readJpegTexture(std::string_view bytes, const std::string& what) {
  JpegReader reader(what);
  jpeg_decompress_struct& info = reader.info;
  jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&info, TRUE);
  info.out_color_space = JCS_RGB;
  Texture texture = emptyTexture(info.image_width, info.image_height, what);
  jpeg_start_decompress(&info);
  const std::size_t row = 3 * static_cast<std::size_t>(texture.width);
  while (info.output_scanline < info.output_height) {
    JSAMPROW to = texture.rgb.data() + row * (info.output_height - 1 - info.output_scanline);
    jpeg_read_scanlines(&info, &to, 1);
  }
  jpeg_finish_decompress(&info);
  return texture;
}

}  // namespace

Texture readTexture(std::string_view bytes, const std::string& what) {
  if (bytes.starts_with("\x89PNG")) return readPngTexture(bytes, what);
  if (bytes.starts_with("\xff\xd8\xff")) return readJpegTexture(bytes, what);
  throw Error({.what = what, .found = "neither PNG nor JPEG", .wanted = "one of them"});
}

}  // namespace rex::mesh
