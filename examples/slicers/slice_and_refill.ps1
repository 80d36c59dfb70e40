# Slice a part with PrusaSlicer, give its infill round corners, and say what that saves.
#
#     powershell -ExecutionPolicy Bypass -File slice_and_refill.ps1 part.stl --load my-settings.ini
#
# Writes part.gcode, as it was sliced, and part.smooth.gcode. All words after the part are PrusaSlicer's: my-settings.ini
# is what its File > Export > Export Config writes. $env:PRUSA_SLICER names the program, if it lies elsewhere.
#
# This script was written beside slice_and_refill.sh, which is tested. It was not run on Windows.

$ErrorActionPreference = "Stop"

if ($args.Count -eq 0) {
    [Console]::Error.WriteLine("usage: slice_and_refill.ps1 PART.stl [option of PrusaSlicer ...]")
    exit 2
}
$part = $args[0]
$options = @($args | Select-Object -Skip 1)
$slicer = $env:PRUSA_SLICER
# prusa-slicer-console.exe waits until it is done, and says what it does; prusa-slicer.exe does neither.
if (-not $slicer) { $slicer = "$env:ProgramFiles\Prusa3D\PrusaSlicer\prusa-slicer-console.exe" }
$plain = [IO.Path]::ChangeExtension($part, ".gcode")
$smooth = [IO.Path]::ChangeExtension($part, ".smooth.gcode")

& $slicer --export-gcode @options --output $plain $part | Out-Null
if ($LASTEXITCODE -ne 0) { exit $LASTEXITCODE }
infill refill $plain --output $smooth --force
if ($LASTEXITCODE -ne 0) { exit $LASTEXITCODE }
infill motion $plain $smooth
exit $LASTEXITCODE
