# shellcheck shell=sh disable=SC2034 # the lists are used by who sources this
# What ./glint, tests/run and bench/run need from the system, and how to get it. Sourced, never run.
#
# A package is written PACKAGE or PACKAGE/COMMAND; the second form also counts as present when the
# command is on the PATH, wherever it came from (a newer CMake, a compiler of one's own).

packages_to_build='
    cmake/cmake ninja-build/ninja gcc/gcc g++/g++ pkg-config/pkg-config
    pocl-opencl-icd ocl-icd-opencl-dev opencl-c-headers
    libopenimageio-dev libtinygltf-dev libmeshoptimizer-dev libdraco-dev nlohmann-json3-dev libjansson-dev
    libxxhash-dev libpng-dev libseccomp-dev'

packages_to_test='
    libcmocka-dev oclgrind/oclgrind clang/clang clang-tidy/clang-tidy
    clang-format/clang-format cppcheck/cppcheck shellcheck/shellcheck
    openexr/exrenvmap tidy/tidy'

packages_to_bench='
    libembree-dev
    libepoxy-dev libegl-dev libegl1 libegl-mesa0 libopengl0 libgl1 libgl1-mesa-dri'

packages_of_renderers='blender/blender povray/povray python3-numpy jq/jq'

packages_to_plot='jq/jq gnuplot-nox/gnuplot util-linux/taskset'

packages_to_test_fully='
    qemu-user/qemu-x86_64 mesa-opencl-icd
    slurmctld slurmd slurm-client munge procps/pkill'

needs_in_words="CMake 3.25, a C11 and C++17 compiler, pkg-config, an OpenCL ICD loader with its \
headers, PoCL or another OpenCL 1.2 driver, OpenImageIO, tinygltf, meshoptimizer, Draco, nlohmann-json, jansson, xxHash, libpng and \
libseccomp"

say() {
    printf 'glint: %s\n' "$*" >&2
}

# Prints those of the packages that are not there, without the commands.
packages_missing() {
    wanted=
    for item in "$@"; do
        case $item in
        */*) command -v "${item#*/}" >/dev/null 2>&1 || wanted="$wanted ${item%%/*}" ;;
        *) wanted="$wanted $item" ;;
        esac
    done
    [ -n "$wanted" ] || return 0
    # shellcheck disable=SC2086,SC2016 # a list of words; dpkg's own ${…}
    installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' $wanted 2>/dev/null |
        sed -n 's/ installed$//p')
    for package in $wanted; do
        printf '%s\n' "$installed" | grep -Fqx "$package" || printf '%s ' "$package"
    done
}

# Runs apt-get as root: directly, or through sudo, which may ask for a password on a terminal only.
as_root_apt() {
    if [ "$(id -u)" -eq 0 ]; then
        DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=600 "$@"
    elif [ -t 0 ] && [ -t 2 ]; then
        sudo env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=600 "$@"
    else
        sudo -n env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=600 "$@"
    fi
}

# packages_install LOG ITEM…: installs what is missing. False, after one line on stderr, where that
# cannot be done.
packages_install() {
    log=$1
    shift
    if ! command -v apt-get >/dev/null 2>&1 || ! command -v dpkg-query >/dev/null 2>&1; then
        packages_without_apt
        return
    fi
    missing=$(packages_missing "$@")
    [ -n "$missing" ] || return 0
    if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null 2>&1; then
        say "packages are missing (as root: apt-get install --no-install-recommends $missing)"
        return 1
    fi
    say "installing packages: $missing"
    # Stale lists are no reason to stop: the packages may be there all the same.
    as_root_apt update >"$log" 2>&1 || true
    # shellcheck disable=SC2086 # a list of words
    if ! as_root_apt install -y --no-install-recommends $missing >>"$log" 2>&1; then
        tail -n 5 "$log" >&2
        say "packages could not be installed (as root: apt-get install" \
            "--no-install-recommends $missing; the log is $log)"
        return 1
    fi
}

# Without apt nothing is installed; the build goes on where its tools are there, and CMake says
# which library it misses.
packages_without_apt() {
    for tool in cmake cc c++ pkg-config; do
        if ! command -v "$tool" >/dev/null 2>&1; then
            say "$tool is missing; without apt, install by hand: $needs_in_words"
            return 1
        fi
    done
}

# build_preset ROOT PRESET LOG [TARGET]: configures where there is no configuration yet, and builds;
# what CMake and the compilers say goes to the log. False where it does not build.
build_preset() {
    build_dir=$1/build/$2
    # A checkout that was copied or moved is configured anew: CMake refuses another one's folder.
    if ! grep -Fqx "CMAKE_HOME_DIRECTORY:INTERNAL=$1" "$build_dir/CMakeCache.txt" 2>/dev/null; then
        rm -rf "$build_dir"
    fi
    if [ ! -f "$build_dir/build.ninja" ] && [ ! -f "$build_dir/Makefile" ]; then
        rm -rf "$build_dir"
        generator='Unix Makefiles'
        ! command -v ninja >/dev/null 2>&1 || generator=Ninja
        (cd "$1" && cmake --preset "$2" -G "$generator") >"$3" 2>&1 || return 1
    else
        : >"$3"
    fi
    build_log=$3
    if [ $# -ge 4 ]; then
        set -- --target "$4"
    else
        set --
    fi
    cmake --build "$build_dir" --parallel "$(nproc 2>/dev/null || echo 2)" "$@" >>"$build_log" 2>&1
}
