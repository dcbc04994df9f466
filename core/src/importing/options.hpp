// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "data/rig_request.hpp"
#include "importing/columns.hpp"
#include "importing/proposal.hpp"
#include "tunica/test.hpp"

namespace tunica::importing {

/// The value of an option of a test as it stands in an experiment file: a number where the option is one. Throws
/// InputError where the test has no such option, or the text is no such value.
Json option_value(const TestFactory& factory, const std::string& key, const std::string& text);

/// How the table stands in its file, as far as the answers say it.
data::TableLayout layout_of(const Answers& answers);
void add_layout(Json& data, const Answers& answers);

/// That of the type; an entry of a type for tubes and solid cylinders is a tube where it gives a wall.
Specimen specimen_of(const TestFactory& factory, const Json& entry);

/// The sizes of a tube, and its axial stretch unless a column has that, as far as the type declares them; what is
/// missing is asked.
void add_tube_options(Json& entry, const TestFactory& factory, const Answers& answers, bool stretch_in_column,
                      const Ask& ask);

/// The loading of a record of time alone: held at one stretch from its beginning to its end. Where the clock has begun
/// ten steps between rows before or more, the specimen rests until the first row. A sentence says what is assumed;
/// empty = nothing is. The stretch is asked, unless "segments" are given; a number there is the stretch.
std::string add_hold(Json& entry, const ColumnGuess& time, const Ask& ask);

}  // namespace tunica::importing
