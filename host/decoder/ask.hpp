// Asks glint for the files that a scene refers to: the sandbox opens none.
#ifndef GLINT_DECODER_ASK_HPP
#define GLINT_DECODER_ASK_HPP

#include "scene/gltf/reader_messages.h"

#include <string>

namespace glint
{

class Asker
{
  public:
    explicit Asker(int socket) : socket_(socket) {}

    // Returns a descriptor of the file that a URI names; the caller closes it. Refuses with the
    // reason, without the URI.
    int open(const std::string &uri);

    // Tells glint how the work ended.
    void tell(glint_status status, const char *message);

  private:
    void begin(glint_reader_kind kind);
    bool send() const;

    int socket_;
    glint_reader_packet packet_ = {};
};

} // namespace glint

#endif
