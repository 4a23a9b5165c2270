// Asks glint for files. See ask.hpp.
#include "decoder/ask.hpp"

#include "decoder/json.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <unistd.h>

namespace glint
{

void Asker::begin(glint_reader_kind kind)
{
    packet_ = {};
    packet_.kind = kind;
    std::snprintf(packet_.version, sizeof packet_.version, "%s", GLINT_VERSION);
}

bool Asker::send() const
{
    return glint_packet_send(socket_, &packet_, sizeof packet_, nullptr, 0);
}

int Asker::open(const std::string &uri)
{
    begin(GLINT_READER_ASK);
    if (uri.find('\0') != std::string::npos) {
        throw refusal("names no file");
    }
    if (uri.size() >= sizeof packet_.text) {
        throw refusal(std::string("cannot be opened: ") + std::strerror(ENAMETOOLONG) +
                      " (put the file beside the scene)");
    }
    std::memcpy(packet_.text, uri.c_str(), uri.size() + 1);
    std::array<int, GLINT_PACKET_FILES_MAX> files{};
    if (!send() || glint_packet_receive(socket_, &packet_, sizeof packet_, files.data()) !=
                       static_cast<ssize_t>(sizeof packet_)) {
        _exit(1); // glint has ended
    }
    if (packet_.status != GLINT_OK || files[0] < 0) {
        packet_.text[sizeof packet_.text - 1] = '\0';
        throw refusal(packet_.text);
    }
    return files[0];
}

void Asker::tell(glint_status status, const char *message)
{
    begin(GLINT_READER_DONE);
    packet_.status = status;
    std::snprintf(packet_.text, sizeof packet_.text, "%s", message);
    (void)send();
}

} // namespace glint
