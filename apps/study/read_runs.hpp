// Reads which runs of a study are made: what is drawn, and when it is enough. For read.cpp alone.
#pragma once

#include "apps/scene/read/reader.hpp"
#include "apps/study/study.hpp"

namespace splashdown::apps {

void read_samples(Reader& reader, Samples& samples);
/// [stop], once axes, quantities and limits are read.
void read_stop(Reader& reader, Study& study);
/// [envelope], likewise.
void read_envelope(Reader& reader, Study& study);

}  // namespace splashdown::apps
