#!/usr/bin/env bash
# Install the Debian or Ubuntu packages that are missing for: build, demo, test, fuzz, lint, peers.
# usage: install_deps.sh [--check] SET
# Asks nothing of the network when all are there. --check installs nothing, and is content on
# systems without dpkg.
set -euo pipefail

check=no
if [ "${1:-}" = --check ]; then
    check=yes
    shift
fi
set_name=${1:?usage: install_deps.sh [--check] build|demo|test|fuzz|lint|peers}

build=(gcc libc6-dev cmake ninja-build pkgconf libspng-dev libtiff-dev libopenexr-dev zlib1g-dev
    libcjson-dev)
# pictures in the terminal; libchafa-dev of Debian 12 does not ask for the second
chafa=(libchafa-dev libglib2.0-dev)
# OpenGL without a window, and what it draws with where there is no GPU
gl=(libepoxy-dev libegl1 libgl1-mesa-dri)
case $set_name in
build) wanted=("${build[@]}") ;;
demo) wanted=("${build[@]}" "${chafa[@]}" "${gl[@]}") ;;
test)
    # clang, g++: the other compilers. libgdal-dev: its readers are tested too. The rest reads our
    # files independently.
    wanted=("${build[@]}" "${chafa[@]}" "${gl[@]}" libcmocka-dev binutils python3 clang g++
        libgdal-dev gdal-bin imagemagick openexr libtiff-tools glslang-tools)
    if ! command -v npm >/dev/null; then # others package node.js as one piece
        wanted+=(nodejs npm)
    fi
    ;;
peers) wanted=("${build[@]}" g++ libembree-dev libbullet-dev) ;;
fuzz) wanted=("${build[@]}" libcmocka-dev clang) ;;
lint) wanted=("${build[@]}" python3 clang-format clang-tidy) ;;
*)
    echo "install_deps: no set is called '$set_name'" >&2
    exit 1
    ;;
esac

if ! command -v dpkg-query >/dev/null; then
    if [ $check = yes ]; then
        exit 0
    fi
    echo "install_deps: no Debian or Ubuntu; please install what these are here: ${wanted[*]}" >&2
    exit 1
fi

missing_of() {
    local package
    for package in "$@"; do
        if [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
            echo "$package"
        fi
    done
}

# install PACKAGE...: those of them that are missing
install() {
    local missing as_root=()
    mapfile -t missing < <(missing_of "$@")
    if [ ${#missing[@]} -eq 0 ]; then
        return
    fi
    if [ $check = yes ]; then
        echo "install_deps: missing: ${missing[*]} (make demo and make test install them)" >&2
        exit 1
    fi
    if [ "$(id -u)" -ne 0 ]; then
        if sudo -n true 2>/dev/null; then
            as_root=(sudo -n)
        elif [ -t 0 ] && command -v sudo >/dev/null; then
            as_root=(sudo)
        else
            echo "install_deps: missing, and no root or sudo to install them: ${missing[*]}" >&2
            exit 1
        fi
    fi
    echo "install_deps: installing ${missing[*]}"
    "${as_root[@]}" apt-get -qq update
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq install -y \
        --no-install-recommends "${missing[@]}" >/dev/null
}

install "${wanted[@]}"
if [ "$set_name" = fuzz ]; then
    # libFuzzer's package carries the version of the clang that is there
    install "libclang-rt-$(clang -dumpversion | cut -d. -f1)-dev"
fi
