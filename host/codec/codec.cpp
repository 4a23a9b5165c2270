// The table of the codec's functions. See image/codec.h.
#include "codec/decode.hpp"

extern "C" __attribute__((visibility("default")))
const glint_codec glint_codec_functions = {GLINT_VERSION, glint::read_image, glint::read_channels,
                                           glint::encode_image, glint::use_threads};
