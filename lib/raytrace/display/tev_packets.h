// What the image viewer tev receives over TCP, port 14158 by default: a picture of a name is made, and rectangles of it
// are replaced. tev answers nothing.
//
// A packet is its length in bytes (uint32, itself included), an operation (uint8) and its fields. Numbers are little
// endian, texts end with a zero byte. (github.com/Tom94/tev, Ipc.h and Ipc.cpp)
#pragma once

#include <cstddef>
#include <string>

#include "raytrace/film/film.h"

namespace raytrace {

/// Operation 4: a black picture with the float channels R, G, B and A. One of the same name is replaced.
std::string create_image_packet(const std::string& image_name, int width, int height);

/// Operation 6: replaces a rectangle. pixels: its first row; the next begins `pitch` pixels after it.
std::string update_image_packet(const std::string& image_name, const Region& rectangle, const Pixel* pixels,
                                std::size_t pitch);

}  // namespace raytrace
