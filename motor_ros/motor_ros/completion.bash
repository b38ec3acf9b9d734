# Completion by TAB of what `ros2 run PACKAGE EXECUTABLE` takes: options, profiles, effects, files. env.sh sources this.
#
# The executable itself is asked, as argcomplete does it. What stands before its arguments (the verb, the package) is
# left to the completion that `ros2` had before, where there was one.

_motor_ros2_before=$(complete -p ros2 2>/dev/null | sed -n 's/.*-F \([^ ]*\) .*/\1/p')
[ "$_motor_ros2_before" != _motor_ros2 ] || _motor_ros2_before=

_motor_executables() { # of a package, or all packages that have some
  local prefix
  local IFS=:
  for prefix in $AMENT_PREFIX_PATH; do
    if [ -n "${1:-}" ]; then
      find -L "$prefix/lib/$1" -maxdepth 1 -type f -executable -printf '%f\n' 2>/dev/null
    else
      find -L "$prefix/lib" -mindepth 2 -maxdepth 2 -type f -executable -printf '%h\n' 2>/dev/null | sed 's#.*/##' | sort -u
    fi
  done
}

_motor_ros2() {
  local current=${COMP_WORDS[COMP_CWORD]} package=${COMP_WORDS[2]:-} executable=${COMP_WORDS[3]:-} file prefix
  if [ "${COMP_WORDS[1]:-}" = run ] && [ "$COMP_CWORD" -ge 4 ]; then
    local IFS=:
    for prefix in $AMENT_PREFIX_PATH; do
      file=$prefix/lib/$package/$executable
      [ ! -x "$file" ] || break
    done
    [[ "$package" == motor_* && -x "$file" ]] || return 0
    local line=${COMP_LINE#*"$executable"} IFS=$'\013'
    line="$executable$line"
    COMPREPLY=($(COMP_LINE=$line COMP_POINT=${#line} COMP_TYPE=$COMP_TYPE _ARGCOMPLETE=1 _ARGCOMPLETE_SHELL=bash \
      _ARGCOMPLETE_COMP_WORDBREAKS=$COMP_WORDBREAKS _ARGCOMPLETE_SUPPRESS_SPACE=1 _ARGCOMPLETE_IFS=$IFS \
      timeout "${MOTOR_COMPLETION_PATIENCE:-5}" "$file" 8>&1 9>/dev/null >/dev/null 2>&1))
    [[ "${COMPREPLY-}" =~ [=/,:]$ ]] && compopt -o nospace 2>/dev/null
  elif [ -n "$_motor_ros2_before" ]; then
    "$_motor_ros2_before" "$@"
  elif [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "run topic service action interface node param pkg bag" -- "$current"))
  elif [ "${COMP_WORDS[1]}" = run ] && [ "$COMP_CWORD" -eq 2 ]; then
    COMPREPLY=($(compgen -W "$(_motor_executables)" -- "$current"))
  elif [ "${COMP_WORDS[1]}" = run ] && [ "$COMP_CWORD" -eq 3 ]; then
    COMPREPLY=($(compgen -W "$(_motor_executables "$package")" -- "$current"))
  fi
}
complete -o bashdefault -o default -F _motor_ros2 ros2
