// The frames of --frames, in the syntax of OpenJD's <IntRangeExpr>.
#pragma once

#include <string>
#include <vector>

namespace raytrace {

/// "1-10", "1-10:3" (1, 4, 7, 10), "10-1:-3" (the same), "-5--1", "7" and lists of them with commas; spaces and tabs
/// may stand between the parts. The frames are in increasing order. Throws SettingsError for anything else, for parts
/// that overlap ("1-9:2,4": 4 lies between 1 and 9) as in
/// https://github.com/OpenJobDescription/openjd-specifications/wiki, "IntRangeExpr", and for more than 100,000 frames.
///
/// One thing differs: by the specification "10-1" is 10 alone, by its reference implementation an error; so it is here.
std::vector<int> frame_numbers(const std::string& text);

/// The short text of such frames, which are in increasing order: "1-10:3,15".
std::string frames_text(const std::vector<int>& frames);

}  // namespace raytrace
