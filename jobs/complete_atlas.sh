# Sourced by the scripts that fill an atlas (bash).
#
#   complete_atlas SCENE ATLAS STYLE [LAUNCHER...]
#
# runs the program at $program with --resume, alone or under a launcher, and $part of the scene (2/8, say) where this is
# set; it returns
#   0 or 10         the atlas is complete; 10: some points could not be integrated
#   75 130 143 129  stopped by SIGUSR1, Ctrl-C, SIGTERM, SIGHUP, or by somebody who asked the run itself to stop (75)
#   another code    what the run ended with: points are missing
# Whether an atlas is complete only the atlas knows: a launcher ends with codes of its own, also behind the last point,
# when the atlas is complete all the same if it is that of the scene. Codes 2 and 3 are the program's word.
# The first signal asks the run to stop in good order, the second ends it.
complete_atlas() {
  local scene=$1 atlas=$2 style=$3 run code heard asked=0 state=0
  shift 3
  # A process group of its own, so that Ctrl-C comes to this shell only: mpirun would kill its ranks.
  set -m
  "$@" "$program" run "$scene" -o "$atlas" ${part:+--part "$part"} --resume --progress "$style" </dev/null &
  run=$!
  set +m
  hand_on() {
    heard=1
    if [ "$asked" = 0 ]; then kill -USR1 "$run" || true; else kill -TERM "$run" || true; fi 2>/dev/null
    asked=$1
  }
  trap 'hand_on 75' USR1
  trap 'hand_on 129' HUP
  trap 'hand_on 130' INT
  trap 'hand_on 143' TERM
  # `wait` returns when a signal arrives, while the run is still ending: then wait again.
  while :; do
    heard=0 code=0
    wait "$run" || code=$?
    [ "$heard" = 1 ] || break
  done
  trap - USR1 HUP INT TERM
  if [ -e "$atlas" ] && [ "$code" != 2 ] && [ "$code" != 3 ]; then
    "$program" status "$atlas" || state=$?
    case $code:$state in
      0:* | 10:*) code=$state ;;
      *:0 | *:10)
        if "$program" run "$scene" -o "$atlas" ${part:+--part "$part"} --resume --dry-run >/dev/null; then
          code=$state
        fi
        ;;
    esac
  fi
  # A limit of time that is reached behind the last point stops nothing; who presses Ctrl-C wants no more.
  case $asked:$code in
    0:* | 75:0 | 75:10) ;;
    *) code=$asked ;;
  esac
  return "$code"
}
# whole_atlas SCENE ATLAS [LAUNCHER...]: for scripts that go on with a complete atlas, and end where it is not.
# Exit code 10, that some points could not be integrated, is no reason to end: the others say enough.
whole_atlas() {
  local code=0
  complete_atlas "$1" "$2" auto "${@:3}" || code=$?
  case $code in
    0 | 10) ;;
    *) echo "$(basename "$0"): $2 is not complete; the same command goes on" >&2 && exit "$code" ;;
  esac
}
