// Runs glint-decoder, which reads one glTF file into a document: read, check, unpack, write. See
// scene/gltf/reader_messages.h. Turns every exception into an answer.
//
// Limits: files of 4 GiB, buffers of 8 GiB.
#include "codec/sandbox.h"
#include "decoder/ask.hpp"
#include "decoder/buffers.hpp"
#include "decoder/check.hpp"
#include "decoder/compose.hpp"
#include "decoder/draco.hpp"
#include "decoder/meshopt.hpp"

#include <array>
#include <csignal>
#include <malloc.h>
#include <new>
#include <sys/prctl.h>
#include <unistd.h>

namespace glint
{

namespace
{

void read(const char *path, int scene, int memory, Limits &limits, Asker &asker)
{
    Writer writer(memory);
    limits.watch(writer.doing());
    SceneFile input(asker, limits);
    Model model;
    model.writer = &writer;
    read_document(path, scene, writer, input);
    check_document(input, model);
    read_buffers(input, writer, model);
    unpack_views(limits, writer, model);
    decode_draco(limits, writer, model);
    settle_attributes(model);
    compose(input, model, writer);
    // glint does not wait until the model's memory is free.
    asker.tell(GLINT_OK, "");
}

// Calls `work` and tells glint how it ended.
template <typename Work>
void guard(const Limits &limits, Asker &asker, Work work)
{
    try {
        work();
    } catch (const refusal &refused) {
        asker.tell(GLINT_BAD_INPUT, refused.what());
    } catch (const shortage &lack) {
        asker.tell(GLINT_OUT_OF_MEMORY, lack.what());
    } catch (const std::bad_alloc &) {
        if (limits.is_by_size()) {
            const std::string most = std::to_string(limits.memory_bytes() >> 20);
            asker.tell(GLINT_BAD_INPUT, ("takes more than " + most +
                                         " MiB to read (it is damaged; or split the scene)")
                                            .c_str());
        } else {
            asker.tell(GLINT_OUT_OF_MEMORY, "not enough memory for the scene");
        }
    } catch (const std::exception &unexpected) {
        asker.tell(GLINT_BAD_INPUT,
                   (std::string("cannot be loaded: ") + unexpected.what()).c_str());
    } catch (...) {
        asker.tell(GLINT_BAD_INPUT, "cannot be loaded");
    }
}

} // namespace

} // namespace glint

// Gives no memory back to the system: the process ends soon.
static void keep_memory()
{
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
    mallopt(M_MMAP_THRESHOLD, 1 << 25);
    mallopt(M_TOP_PAD, 1 << 20);
}

int main()
{
    static glint_reader_packet start;
    std::array<int, GLINT_PACKET_FILES_MAX> files{};
    const bool is_asked =
        glint_packet_receive(GLINT_READER_SOCKET, &start, sizeof start, files.data()) ==
            static_cast<ssize_t>(sizeof start) &&
        start.kind == GLINT_READER_START && files[0] >= 0 && files[1] >= 0;
    if (!is_asked) {
        return 1;
    }
    (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
    (void)std::signal(SIGXFSZ, SIG_IGN);
    keep_memory();
    glint_sandbox_leave_no_core();
    glint::Limits limits(start.free_bytes);
    (void)glint_sandbox_enter(false);
    glint::Asker asker(GLINT_READER_SOCKET);
    glint::guard(limits, asker,
                 [&] { glint::read(start.text, files[0], files[1], limits, asker); });
    _exit(0); // skips the exit handlers of libraries that may be broken
}
