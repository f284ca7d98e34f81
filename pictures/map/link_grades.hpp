// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace rovernet {

/// Style of a link's line for a range of link margins. The link margin is the level [dB] above the
/// receiver's sensitivity.
struct LinkGrade {
    double from;       ///< smallest margin of the grade [dB]
    double width;      ///< width of the line [px]
    double shade;      ///< place on the colour scale `ember`, from 0 to 1
    const char* text;  ///< range of margins in words
};

/// Grades of links in pictures, in ascending order of margins. A larger margin has a darker and
/// wider line.
inline constexpr std::array link_grades{
    LinkGrade{0, 1.3, 0.0, "0 to 5 dB"},    LinkGrade{5, 1.8, 0.25, "5 to 10 dB"},
    LinkGrade{10, 2.4, 0.5, "10 to 20 dB"}, LinkGrade{20, 3.0, 0.75, "20 to 30 dB"},
    LinkGrade{30, 3.6, 1.0, "over 30 dB"},
};

/// Index of the grade of a margin [dB].
inline std::size_t grade_of(double margin) {
    std::size_t i = link_grades.size() - 1;
    while (i > 0 && margin < link_grades[i].from) --i;
    return i;
}

}  // namespace rovernet
