// Finds the picture in a file of several parts or layers.
#ifndef GLINT_CODEC_PARTS_HPP
#define GLINT_CODEC_PARTS_HPP

#include "codec/decode.h"

#include <OpenImageIO/imageio.h>

namespace glint
{

// The places of R, G, B or of grey, and of alpha, among the channels of a part; −1 if missing.
struct Picked {
    int color[3] = {-1, -1, -1};
    int alpha = -1;
    int colors = 0; // 1 or 3; 0: nothing found

    int channels() const
    {
        return colors + (alpha >= 0 ? 1 : 0);
    }
    int place(int channel) const
    {
        return channel < colors ? color[channel] : alpha;
    }
};

// The part and the channels that hold a file's picture.
struct Part {
    int index = 0;
    OIIO::ImageSpec spec;
    Picked picked;
};

// Finds the picture. Of an EXR with several, a name decides, or one picture alone has colour. Of
// other files it is the first part with colour or grey. Errors: GLINT_BAD_INPUT, which names the
// parts and layers to choose from.
glint_status find_part(const glint_codec_request &request, OIIO::ImageInput &input, Part &part,
                       glint_error *error);

} // namespace glint

#endif
