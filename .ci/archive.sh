# The archive that runs anywhere: `./x package` and the test of it. Read by ../x.
# shellcheck shell=bash disable=SC2154 # root, program, target, system and machine are set there

# Prints the archive's name without its ending: lightbench-VERSION-OS-ARCH.
archive_name() {
    local version os=linux
    version=$(sed -n 's/^version *= *"\(.*\)"/\1/p' "$root/Cargo.toml" | head -n 1)
    if [ "$system" = Darwin ]; then os=macos; fi
    printf 'lightbench-%s-%s-%s\n' "$version" "$os" "$machine"
}

# Writes out/NAME.tar.gz and its checksum. The program carries its shaders, scripts and lessons, so
# the archive needs nothing beside it. The same files give the same archive, byte for byte.
make_archive() {
    local name stage time
    name=$(archive_name)
    stage=$root/out/stage
    rm -rf "$stage"
    mkdir -p "$stage/$name"
    strip -o "$stage/$name/lightbench" "$program"
    cp "$root/README.md" "$root/LICENSE-MIT" "$root/LICENSE-APACHE" "$root/CITATION.cff" "$stage/$name/"
    # What the README sends a student to, under the same path.
    mkdir -p "$stage/$name/engine/script"
    cp -R "$root/engine/script/docs" "$stage/$name/engine/script/docs"
    find "$stage/$name/engine" -type d -exec chmod 755 {} +
    find "$stage/$name/engine" -type f -exec chmod 644 {} +
    list_licences >"$stage/$name/THIRD-PARTY.txt"
    chmod 755 "$stage/$name" "$stage/$name/lightbench"
    chmod 644 "$stage/$name"/*.* "$stage/$name"/LICENSE-*

    time=${SOURCE_DATE_EPOCH:-$(git -C "$root" log -1 --format=%ct 2>/dev/null || echo 0)}
    (
        cd "$stage" || exit
        if tar --version | grep -q GNU; then
            tar --sort=name --mtime="@$time" --owner=0 --group=0 --numeric-owner -cf - "$name"
        else # macOS: sort and date the files ourselves
            find "$name" -exec touch -t "$(date -u -r "$time" +%Y%m%d%H%M.%S)" {} +
            find "$name" -type f | LC_ALL=C sort | tar --uid 0 --gid 0 --uname '' --gname '' -cf - -T -
        fi | gzip -9 -n >"$root/out/$name.tar.gz.tmp"
    )
    mv "$root/out/$name.tar.gz.tmp" "$root/out/$name.tar.gz"
    (
        cd "$root/out" || exit
        if command -v sha256sum >/dev/null; then sha256sum "$name.tar.gz"; else shasum -a 256 "$name.tar.gz"; fi
    ) >"$root/out/$name.tar.gz.sha256"
    rm -rf "$stage"
}

# Prints the crates inside the program with their licences, and each licence text once.
list_licences() {
    local cargo_home=${CARGO_HOME:-$home/.cargo} crates
    cargo_home=${cargo_home//\\//} # as bash on Windows wants it
    crates=$(
        cd "$root" && cargo tree --locked --package lightbench-editor --edges normal --prefix none \
            --format '{p}|{l}' | grep -v '^lightbench' | sed 's/ (\*)$//; s/ (proc-macro)//' | LC_ALL=C sort -u
    )
    printf 'Lightbench is built from these crates, each under its own licence.\n\n'
    printf '%s\n' "$crates" | sed 's/|/: /'
    printf '%s\n' "$crates" | sed 's/|.*//; s/ v/-/' | licence_files "$cargo_home" | tr '\n' '\0' |
        xargs -0 cksum | LC_ALL=C sort -k 3 | awk '
        {
            path = $0
            sub(/^[0-9]+ [0-9]+ /, "", path)
            user = path
            sub(/.*\/registry\/src\/[^\/]*\//, "", user)
            sub(/\/.*/, "", user)
            text = $1 " " $2
            if (!(text in first)) { first[text] = path; order[++count] = text }
            if (last[text] != user) users[text] = users[text] " " user
            last[text] = user
        }
        END {
            for (i = 1; i <= count; i++) {
                printf "\n%s\nUsed by:%s\n\n", "----------------------------------------", users[order[i]]
                while ((getline line < first[order[i]]) > 0) print line
            }
        }'
}

# Reads NAME-VERSION lines, and prints the files in those crates that hold a licence, fonts included.
licence_files() (
    shopt -s nullglob nocaseglob
    while read -r crate; do
        for file in "$1"/registry/src/*/"$crate"/{,*/}{licen[cs]e*,copying*,notice*,unlicense*,*ofl*.txt,*ufl*.txt}; do
            if [ -f "$file" ]; then printf '%s\n' "$file"; fi
        done
    done
)

# Unpacks the archive in an empty folder and renders there with a bare environment: no Rust, no
# source tree, and no network where the kernel lets an ordinary user take it away.
try_archive() {
    local archive work folder apart=() driver=() name
    archive=$root/out/$(archive_name).tar.gz
    work=$(mktemp -d)
    folder=$work/práctica\ 1\ ñ
    mkdir -p "$folder" "$work/home"
    tar -xzf "$archive" -C "$folder" --strip-components 1

    # A program that knows where its data lay when it was built would find them there, and hide that
    # it needs them.
    for name in scripts shaders lessons engine editor; do
        if grep -q -F -- "$root/$name/" "$folder/lightbench"; then
            say "the program contains the path of the source tree: $root/$name/"
            return 1
        fi
    done
    if unshare --user --map-root-user --net true 2>/dev/null; then
        apart=(unshare --user --map-root-user --net)
    fi
    for name in LD_LIBRARY_PATH VK_DRIVER_FILES VK_ICD_FILENAMES; do
        if [ -n "${!name:-}" ]; then driver+=("$name=${!name}"); fi
    done
    (
        cd "$folder" &&
            ${apart[@]+"${apart[@]}"} env -i PATH=/nonexistent HOME="$work/home" ${driver[@]+"${driver[@]}"} \
                ./lightbench render cornell_box --pipeline forward_single_pass --size 64x36 --out picture.png
    ) || return 1
    # Eight bytes of signature, then the header's chunk with width and height.
    if [ "$(head -c 24 "$folder/picture.png" | od -An -tx1 | tr -d ' \n')" != \
        89504e470d0a1a0a0000000d494844520000004000000024 ]; then
        say "the unpacked program wrote no PNG of 64 by 36 pixels"
        return 1
    fi
    rm -rf "$work"
}
