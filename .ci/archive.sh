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
    local cargo_home=${CARGO_HOME:-$home/.cargo} work crate licence name version directory file sum
    cargo_home=${cargo_home//\\//} # as bash on Windows wants it
    work=$(mktemp -d)
    printf 'Lightbench is built from these crates, each under its own licence.\n\n'
    (cd "$root" && cargo tree --locked --package lightbench-editor --edges normal --prefix none \
        --format '{p}|{l}') | grep -v '^lightbench' | sed 's/ (\*)$//; s/ (proc-macro)//' | LC_ALL=C sort -u |
        while IFS='|' read -r crate licence; do
            printf '%s: %s\n' "$crate" "${licence:-see its text below}"
            name=${crate%% v*} version=${crate##* v}
            for directory in "$cargo_home"/registry/src/*/"$name-$version"; do
                find "$directory" -maxdepth 2 -type f \( -iname 'licen[cs]e*' -o -iname 'copying*' \
                    -o -iname 'notice*' -o -iname 'unlicense*' -o -iname '*OFL*.txt' -o -iname '*UFL*.txt' \) |
                    LC_ALL=C sort | while read -r file; do
                    sum=$(cksum <"$file")
                    sum=${sum// /-}
                    cp "$file" "$work/$sum.text"
                    printf '%s ' "$name" >>"$work/$sum.users"
                done
            done
        done
    for file in "$work"/*.text; do
        printf '\n%s\n' '--------------------------------------------------------------------------------'
        printf 'Used by: %s\n\n' "$(tr ' ' '\n' <"${file%.text}.users" | LC_ALL=C sort -u | xargs)"
        cat "$file"
    done
    rm -rf "$work"
}

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
